"""An OPC UA server as a PLC has it (asyncua), on port sys.argv[1]. A line of stdin sets a node; what a client writes is said as JSON."""
import asyncio, json, sys
from asyncua import Server, ua

async def main():
    server = Server()
    await server.init()
    server.set_endpoint(f"opc.tcp://127.0.0.1:{sys.argv[1]}/plc")
    index = await server.register_namespace("http://plc.example/")
    folder = await server.nodes.objects.add_object(index, "Cell")
    part = await folder.add_variable(ua.NodeId("PartThere", index), "PartThere", False)
    grip = await folder.add_variable(ua.NodeId("Grip", index), "Grip", False)
    await grip.set_writable()
    async with server:
        print(json.dumps({"index": index}), flush=True)
        last = False
        async def tell():
            nonlocal last
            while True:
                now = await grip.read_value()
                if now != last:
                    last = now
                    print(json.dumps({"grip": now}), flush=True)
                await asyncio.sleep(0.02)
        telling = asyncio.create_task(tell())
        while True:
            line = await asyncio.to_thread(sys.stdin.readline)
            if not line: break
            await part.write_value(json.loads(line)["part"])
        telling.cancel()

asyncio.run(main())
