"""asyncua against the OPC UA server: sys.argv[1]. Says what it found as JSON lines."""
import asyncio, json, sys
from asyncua import Client, ua

async def main():
    client = Client(sys.argv[1], timeout=20)
    async with client:
        nr = await client.get_namespace_index("http://opcfoundation.org/UA/Robotics/")
        nd = await client.get_namespace_index("http://opcfoundation.org/UA/DI/")
        devices = await client.nodes.objects.get_child([f"{nd}:DeviceSet"])
        types = {}
        for node in await devices.get_children():
            kind = await node.read_type_definition()
            types[(await node.read_browse_name()).Name] = (node, (kind.NamespaceIndex == nr, kind.Identifier))
        systems = {name: list(kind) for name, (_, kind) in types.items() if kind[0]}
        system = types["arm"][0]
        device = (await (await system.get_child([f"{nr}:MotionDevices"])).get_children())[0]
        axes = await (await device.get_child([f"{nr}:Axes"])).get_children()
        positions = [await axis.get_child([f"{nd}:ParameterSet", f"{nr}:ActualPosition"]) for axis in axes]
        unit = (await (await positions[0].get_child(["0:EngineeringUnits"])).read_value()).DisplayName.Text
        async def text(node, *path): return (await (await node.get_child(list(path))).read_value())
        safety = (await (await system.get_child([f"{nr}:SafetyStates"])).get_children())[0]
        stop = await safety.get_child([f"{nd}:ParameterSet", f"{nr}:EmergencyStop"])
        mode = await safety.get_child([f"{nd}:ParameterSet", f"{nr}:OperationalMode"])
        controller = (await (await system.get_child([f"{nr}:Controllers"])).get_children())[0]
        controls = await controller.get_references(refs=ua.NodeId(4002, nr), direction=ua.BrowseDirection.Forward)
        trains = await (await device.get_child([f"{nr}:PowerTrains"])).get_children()
        moves = await trains[0].get_references(refs=ua.NodeId(18178, nr), direction=ua.BrowseDirection.Forward)
        try:
            await positions[0].write_value(ua.DataValue(ua.Variant(1.0, ua.VariantType.Double))); wrote = "written"
        except ua.UaStatusCodeError as problem:
            wrote = type(problem).__name__
        print(json.dumps({
            "systems": systems, "unit": unit, "positions": await client.read_values(positions), "write": wrote,
            "manufacturer": (await text(device, f"{nd}:Manufacturer")).Text, "model": (await text(device, f"{nd}:Model")).Text,
            "category": await text(device, f"{nr}:MotionDeviceCategory"), "override": await text(device, f"{nd}:ParameterSet", f"{nr}:SpeedOverride"),
            "emergency": await stop.read_value(), "mode": await mode.read_value(), "trains": len(trains),
            "controls": [r.BrowseName.Name for r in controls], "moves": [r.BrowseName.Name for r in moves],
        }))
        seen, changed = [], asyncio.Event()
        class Handler:
            def datachange_notification(self, node, value, data):
                if node == stop:
                    if value: changed.set()
                else: seen.append(value)
        subscription = await client.create_subscription(20, Handler())
        await subscription.subscribe_data_change(positions + [stop], sampling_interval=20, queuesize=50)
        await asyncio.sleep(0.2); seen.clear()
        print(json.dumps({"subscribed": True}))
        await asyncio.wait_for(changed.wait(), 30)
        print(json.dumps({"changes": len(seen), "distinct": len(set(seen)), "first": seen[0] if seen else None, "last": seen[-1] if seen else None}))
        print(json.dumps({"closed": await asyncio.to_thread(sys.stdin.readline) and [
            (await n.read_browse_name()).Name for n in await devices.get_children() if (await n.read_type_definition()).NamespaceIndex == nr]}))

asyncio.run(main())
