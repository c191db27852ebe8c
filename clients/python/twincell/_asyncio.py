"""The client for asyncio. Requests wait in threads of their own; samples come on the event loop."""

from __future__ import annotations

import asyncio
import json
import ssl
from types import TracebackType
from typing import Any, AsyncIterator, Sequence

from websockets.asyncio.client import connect as open_socket

from ._sync import Lease, Robot, Server


class AsyncServer:
    """As `Server`, with coroutines."""

    def __init__(self, url: str, token: str | None = None, context: ssl.SSLContext | None = None) -> None:
        self.sync = Server(url, token, context)

    async def about(self) -> dict[str, Any]:
        return await asyncio.to_thread(self.sync.about)

    async def models(self) -> list[dict[str, Any]]:
        return await asyncio.to_thread(self.sync.models)

    async def robots(self) -> list[dict[str, Any]]:
        return await asyncio.to_thread(self.sync.robots)

    def robot(self, id: str) -> AsyncRobot:
        return AsyncRobot(self.sync.robot(id))

    async def open(self, id: str, driver: str, model: str, **more: Any) -> AsyncRobot:
        return AsyncRobot(await asyncio.to_thread(self.sync.open, id, driver, model, **more))

    async def check(
        self, program: Any, model: str | None = None, cell: Any = None, margin_m: float = 0.0
    ) -> dict[str, Any]:
        return await asyncio.to_thread(self.sync.check, program, model, cell, margin_m)

    async def plan(
        self, program: Any, model: str | None = None, cell: Any = None, period_s: float = 0.01
    ) -> dict[str, Any]:
        return await asyncio.to_thread(self.sync.plan, program, model, cell, period_s)

    async def write(self, program: Any, language: str, model: str | None = None, cell: Any = None) -> dict[str, Any]:
        return await asyncio.to_thread(self.sync.write, program, language, model, cell)

    async def stop(self, emergency: bool = False) -> None:
        await asyncio.to_thread(self.sync.stop, emergency)


class AsyncRobot:
    """As `Robot`, with coroutines."""

    def __init__(self, robot: Robot) -> None:
        self.sync = robot
        self.id = robot.id

    async def state(self) -> dict[str, Any]:
        return await asyncio.to_thread(self.sync.state)

    async def events(self, rate_hz: float | None = None) -> AsyncIterator[dict[str, Any]]:
        connection = self.sync.connection
        async with open_socket(
            connection.stream_url(self.id, rate_hz),
            additional_headers=connection.headers(),
            ssl=connection.context,
            compression=None,
            max_size=None,
        ) as socket:
            async for message in socket:
                yield json.loads(message)

    async def samples(self, rate_hz: float | None = None) -> AsyncIterator[dict[str, Any]]:
        async for event in self.events(rate_hz):
            if event["type"] == "sample":
                yield event

    async def lease(self, who: str = "python", expires_s: float = 30.0) -> AsyncLease:
        return AsyncLease(await asyncio.to_thread(self.sync.lease, who, expires_s))

    async def stop(self, emergency: bool = False) -> None:
        await asyncio.to_thread(self.sync.stop, emergency)

    async def hold(self) -> None:
        await asyncio.to_thread(self.sync.hold)

    async def close(self) -> None:
        await asyncio.to_thread(self.sync.close)


class AsyncLease:
    """As `Lease`, with coroutines. A cancelled motion stops the robot."""

    def __init__(self, lease: Lease) -> None:
        self.sync = lease

    async def _motion(self, *call: Any) -> None:
        try:
            await asyncio.to_thread(*call)
        except asyncio.CancelledError:
            # A thread cannot be ended from outside: its request goes on until the robot stands.
            self.sync.robot.stop()
            raise

    async def connect(self) -> None:
        await asyncio.to_thread(self.sync.connect)

    async def disconnect(self) -> None:
        await asyncio.to_thread(self.sync.disconnect)

    async def confirm(self) -> None:
        await asyncio.to_thread(self.sync.confirm)

    async def speed(self, percent: float) -> None:
        await asyncio.to_thread(self.sync.speed, percent)

    async def move(self, q_rad: Sequence[float]) -> None:
        await self._motion(self.sync.move, q_rad)

    async def run(self, program: Any, as_text: bool = False, despite: Sequence[str] = ()) -> None:
        await self._motion(self.sync.run, program, as_text, despite)

    async def produce(self, program: Any, cycles: int | None = None, breakpoints: Sequence[str] = ()) -> None:
        await self._motion(self.sync.produce, program, cycles, breakpoints)

    async def replace(self, program: Any) -> None:
        await asyncio.to_thread(self.sync.replace, program)

    async def resume(self, at: str = "step") -> None:
        await asyncio.to_thread(self.sync.resume, at)

    async def step(self) -> None:
        await asyncio.to_thread(self.sync.step)

    async def release(self) -> None:
        await asyncio.to_thread(self.sync.release)

    async def __aenter__(self) -> AsyncLease:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.release()
