"""Against a running server, whose address and data are in TWINCELL_URL; apps/server/src/python-client.test.ts starts one."""

from __future__ import annotations

import asyncio
import os
import threading
from typing import Any

import pytest
import twincell

URL = os.environ["TWINCELL_URL"]
HOME = [0.0, -1.5707963, 1.5707963, -1.5707963, -1.5707963, 0.0]


def target(by_rad: float) -> list[float]:
    return [by_rad, *HOME[1:]]


def program(q_rad: list[float]) -> dict[str, Any]:
    return {
        "format": "twincell.program",
        "version": VERSION,
        "name": "To",
        "robot": "ur10e",
        "steps": [{"id": "a", "type": "move", "path": "ptp", "speed": {"ratio": 0.3}, "target": {"q": q_rad}}],
    }


VERSION = int(os.environ["TWINCELL_PROGRAM_VERSION"])


@pytest.fixture
def arm() -> Any:
    robot = twincell.Server(URL).open("arm", driver="ur", model="ur10e")
    yield robot
    robot.stop()
    robot.close()


def test_connect_move_and_stream_into_pandas(arm: twincell.Robot) -> None:
    with arm.lease("pytest") as lease:
        lease.connect()
        lease.move(target(0.1))
        mover = threading.Thread(target=lease.move, args=(target(0.4),))
        mover.start()
        table = twincell.frame(arm.samples(seconds=1.0))
        mover.join()
    assert len(table) > 20
    assert table.index.is_monotonic_increasing
    assert table["q1_rad"].max() - table["q1_rad"].min() > 0.01
    assert abs(arm.state()["sample"]["q_rad"][0] - 0.4) < 1e-3


def test_a_motion_that_is_stopped_and_one_without_right_raise_their_reasons(arm: twincell.Robot) -> None:
    with arm.lease("pytest") as lease:
        lease.connect()
        lease.move(target(0.0))
        with pytest.raises(twincell.Refused) as taken:
            arm.lease("another")
        assert "pytest" in taken.value.sentence
        problems: list[Exception] = []

        def move() -> None:
            try:
                lease.move(target(2.0))
            except twincell.ApiError as problem:
                problems.append(problem)

        mover = threading.Thread(target=move)
        mover.start()
        for sample in arm.samples():
            if sample["moving"]:
                break
        arm.stop()
        mover.join()
        assert [type(each) for each in problems] == [twincell.Stopped]
        with pytest.raises(twincell.Refused):
            lease.move([9.0] * 6)


def test_check_plan_and_write() -> None:
    server = twincell.Server(URL)
    assert server.check(program(target(0.3)))["ok"] is True
    assert server.check(program([9.0, *HOME[1:]]))["ok"] is False
    plan = server.plan(program(target(0.3)), period_s=0.02)
    assert plan["kind"] == "planned"
    assert plan["q_rad"][-1][0] == pytest.approx(0.3, abs=1e-6)
    assert "movej" in server.write(program(target(0.3)), "urscript")["files"][0]["text"]
    with pytest.raises(twincell.Refused) as nothing:
        server.check({"format": "else"})
    assert nothing.value.code == "program.unreadable"


def test_a_recording_of_what_moved_is_fetched_and_read_with_mcap(arm: twincell.Robot, tmp_path: Any) -> None:
    from mcap.reader import make_reader

    server = twincell.Server(URL)
    with arm.lease("pytest") as lease:
        lease.connect()
        lease.move(target(0.2))
    arm.close()
    try:
        newest = max((each for each in server.recordings() if each["robot"] == "arm"), key=lambda each: each["file"])
        path = server.recording("arm", newest["file"], tmp_path / "arm.mcap")
        with path.open("rb") as file:
            topics = {channel.topic for _, channel, _ in make_reader(file).iter_messages()}
        assert "/joint_states" in topics
    finally:
        server.open("arm", driver="ur", model="ur10e")


def test_asyncio_moves_while_samples_come(arm: twincell.Robot) -> None:
    async def main() -> int:
        robot = twincell.AsyncServer(URL).robot("arm")
        async with await robot.lease("asyncio") as lease:
            await lease.connect()
            await lease.move(target(0.0))
            moving = asyncio.create_task(lease.move(target(0.5)))
            seen = 0
            async for sample in robot.samples(rate_hz=50):
                seen += sample["moving"]
                if seen and not sample["moving"]:
                    break
            await moving
            return seen

    assert asyncio.run(main()) > 5


def test_nobody_there_is_one_sentence() -> None:
    with pytest.raises(twincell.Unreachable, match="gave no answer"):
        twincell.Server("http://127.0.0.1:9").robots()
    with pytest.raises(ValueError, match="is no address"):
        twincell.Server("127.0.0.1:7341")
