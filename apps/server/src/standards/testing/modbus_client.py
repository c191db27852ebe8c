"""pymodbus against the Modbus port: sys.argv[1]. Says what it read as JSON lines; reads commands from stdin."""
import json, socket, struct, sys
from pymodbus.client import ModbusTcpClient

port = int(sys.argv[1])
client = ModbusTcpClient("127.0.0.1", port=port, timeout=3)
assert client.connect()

def words(read, address, count):
    answer = read(address, count=count, device_id=1)
    return {"exception": answer.exception_code} if answer.isError() else answer.registers

def bits(read, address, count):
    answer = read(address, count=count, device_id=1)
    return {"exception": answer.exception_code} if answer.isError() else answer.bits[:count]

head = words(client.read_input_registers, 0, 4)
raw = words(client.read_input_registers, 10, 12)
joints = [v for v in struct.unpack(">6i", struct.pack(">12H", *raw))]
wrote = client.write_coil(3, True, device_id=1)
many = client.write_coils(0, [True, False], device_id=1)
print(json.dumps({
    "head": head, "joints": joints, "holding": words(client.read_holding_registers, 1, 2) == head[1:3],
    "wrote": not wrote.isError(), "many": not many.isError(),
    "coils": bits(client.read_coils, 0, 4), "inputs": bits(client.read_discrete_inputs, 0, 4),
    "none": words(client.read_input_registers, 60000, 2), "register": client.write_register(1, 5, device_id=1).exception_code,
}))
s = socket.create_connection(("127.0.0.1", port)); s.settimeout(3)
def raw_ask(*parts):
    for part in parts: s.sendall(part)
    return s.recv(300).hex()
print(json.dumps({
    "count0": raw_ask(struct.pack(">HHHBBHH", 3, 0, 6, 1, 3, 0, 0)),
    "unknown": raw_ask(struct.pack(">HHHBB", 4, 0, 2, 1, 99)),
    "split": raw_ask(struct.pack(">HHH", 5, 0, 6), struct.pack(">BBHH", 1, 4, 2, 1)),
}))
s.sendall(b"GET / HTTP/1.1\r\n\r\n")
print(json.dumps({"garbage": s.recv(10).hex()}))
sys.stdin.readline()
print(json.dumps({"moving": words(client.read_input_registers, 0, 1)[0] & 2}))
print(json.dumps({"stopped": not client.write_coil(1999, True, device_id=1).isError()}))
