"""A Sparkplug host with paho: broker port sys.argv[1]. Says every payload as a JSON line; a line on stdin asks for births."""
import json, struct, sys, time
import paho.mqtt.client as mqtt

def varint(b, i):
    r = s = 0
    while True:
        x = b[i]; i += 1; r |= (x & 127) << s; s += 7
        if x < 128: return r, i

def fields(b):
    i, out = 0, []
    while i < len(b):
        k, i = varint(b, i); f, w = k >> 3, k & 7
        if w == 0: v, i = varint(b, i)
        elif w == 1: v, i = struct.unpack("<d", b[i:i + 8])[0], i + 8
        elif w == 5: v, i = struct.unpack("<f", b[i:i + 4])[0], i + 4
        else: n, i = varint(b, i); v, i = b[i:i + n], i + n
        out.append((f, v))
    return out

def payload(b):
    out = {"metrics": []}
    for f, v in fields(b):
        if f == 3: out["seq"] = v
        elif f == 1: out["time"] = v
        elif f == 2:
            e = dict(fields(v))
            value = next((e[k] for k in (13, 11, 10, 12, 14, 15) if k in e), None)
            out["metrics"].append({"name": e[1].decode() if 1 in e else None, "alias": e.get(2), "type": e.get(4),
                                   "value": value.decode() if isinstance(value, bytes) else value})
    return out

client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2, client_id="host")
def heard(_client, _user, message):
    kind = message.topic.split("/")[2]
    print(json.dumps({"topic": message.topic, "kind": kind, "retain": message.retain, **payload(message.payload)}), flush=True)
client.on_message = heard
client.on_subscribe = lambda *_: print(json.dumps({"kind": "subscribed"}), flush=True)
client.connect("127.0.0.1", int(sys.argv[1]))
client.subscribe("spBv1.0/#", 1)
client.loop_start()
for line in sys.stdin:
    # A metric "Node Control/Rebirth" that is true.
    name = b"Node Control/Rebirth"
    metric = b"\x0a" + bytes([len(name)]) + name + b"\x20\x0b\x70\x01"
    client.publish("spBv1.0/plant/NCMD/" + json.loads(line), b"\x12" + bytes([len(metric)]) + metric)
