"""A receiver of webhooks with the standard library: says each delivery as a JSON line; refuses the first argv[1] of them."""
import hashlib, hmac, json, sys
from http.server import BaseHTTPRequestHandler, HTTPServer

refuse = int(sys.argv[1])
class Receiver(BaseHTTPRequestHandler):
    def do_POST(self):
        global refuse
        body = self.rfile.read(int(self.headers["content-length"]))
        if refuse > 0:
            refuse -= 1
            self.send_response(503); self.end_headers()
            return
        wanted = "sha256=" + hmac.new(b"a secret of the plant", body, hashlib.sha256).hexdigest()
        self.send_response(204); self.end_headers()
        print(json.dumps({"signed": hmac.compare_digest(wanted, self.headers["twincell-signature"]),
                          "type": self.headers["content-type"], "event": self.headers["twincell-event"], "body": json.loads(body)}), flush=True)
    def log_message(self, *_): pass

server = HTTPServer(("127.0.0.1", 0), Receiver)
print(json.dumps({"port": server.server_port}), flush=True)
server.serve_forever()
