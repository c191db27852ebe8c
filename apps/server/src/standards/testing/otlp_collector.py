"""A collector of traces with the protobuf types that OpenTelemetry publishes: says each span as a JSON line."""
import base64, gzip, json
from http.server import BaseHTTPRequestHandler, HTTPServer
from google.protobuf.json_format import Parse
from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest

def ids(value):
    """Ids are hex in OTLP's JSON and base64 in protobuf's."""
    if isinstance(value, dict):
        return {k: base64.b64encode(bytes.fromhex(v)).decode() if k in ("traceId", "spanId", "parentSpanId") else ids(v) for k, v in value.items()}
    return [ids(v) for v in value] if isinstance(value, list) else value

class Collector(BaseHTTPRequestHandler):
    def do_POST(self):
        body = b""
        if self.headers.get("transfer-encoding") == "chunked":
            while size := int(self.rfile.readline(), 16):
                body += self.rfile.read(size); self.rfile.readline()
            self.rfile.readline()
        else: body = self.rfile.read(int(self.headers["content-length"]))
        if self.headers.get("content-encoding") == "gzip": body = gzip.decompress(body)
        request = Parse(json.dumps(ids(json.loads(body))), ExportTraceServiceRequest())
        self.send_response(200); self.send_header("content-type", "application/json"); self.end_headers(); self.wfile.write(b"{}")
        for resource in request.resource_spans:
            service = {a.key: a.value.string_value for a in resource.resource.attributes}.get("service.name")
            for scope in resource.scope_spans:
                for span in scope.spans:
                    values = {a.key: a.value.string_value or a.value.int_value for a in span.attributes}
                    print(json.dumps({"path": self.path, "service": service, "name": span.name, "error": span.status.code == 2,
                                      "ms": (span.end_time_unix_nano - span.start_time_unix_nano) / 1e6, **values}), flush=True)
    def log_message(self, *_): pass

server = HTTPServer(("127.0.0.1", 0), Collector)
print(json.dumps({"port": server.server_port}), flush=True)
server.serve_forever()
