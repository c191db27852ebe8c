"""The client for scripts and notebooks."""

from __future__ import annotations

import json
import ssl
import time
from pathlib import Path
from types import TracebackType
from typing import Any, Iterator, Sequence

from websockets.sync.client import connect as open_socket

from ._http import Connection, judged, robot_path


class Server:
    """A Twincell server. `token` is one of `twincell token add`, or the access code of `serve --lan`."""

    def __init__(self, url: str, token: str | None = None, context: ssl.SSLContext | None = None) -> None:
        self.connection = Connection(url, token, context)

    def about(self) -> dict[str, Any]:
        return self.connection.request("GET", "/api/v1")

    def models(self) -> list[dict[str, Any]]:
        """Robot models of the library, with the limits of their joints."""
        return self.connection.request("GET", "/api/v1/models")["models"]

    def robots(self) -> list[dict[str, Any]]:
        return self.connection.request("GET", "/api/v1/robots")["robots"]

    def robot(self, id: str) -> Robot:
        """A robot that is open already."""
        return Robot(self.connection, id)

    def open(self, id: str, driver: str, model: str, **more: Any) -> Robot:
        """Opens a robot: a virtual controller, or with `address={"host": …}` a driver to one that is there."""
        self.connection.request("POST", "/api/v1/robots", {"id": id, "driver": driver, "model": model, **more})
        return Robot(self.connection, id)

    def check(self, program: Any, model: str | None = None, cell: Any = None, margin_m: float = 0.0) -> dict[str, Any]:
        """Judges a program: reach, limits, speed, torque, branches; collision when a cell is given."""
        body = judged(program, model, cell, margin_m=margin_m)
        return self.connection.request("POST", "/api/v1/check", body, timeout_s=150.0)

    def plan(self, program: Any, model: str | None = None, cell: Any = None, period_s: float = 0.01) -> dict[str, Any]:
        """The motion of a program over time: `time_s`, `q_rad` [rad], `step`; `kind` is "planned" or "stuck" with the reason."""
        body = judged(program, model, cell, period_s=period_s)
        return self.connection.request("POST", "/api/v1/plan", body, timeout_s=150.0)

    def write(self, program: Any, language: str, model: str | None = None, cell: Any = None) -> dict[str, Any]:
        """The program in a controller's language, executed and compared with the plan first."""
        body = judged(program, model, cell, language=language)
        return self.connection.request("POST", "/api/v1/write", body, timeout_s=150.0)

    def recordings(self) -> list[dict[str, Any]]:
        return self.connection.request("GET", "/api/v1/recordings")["recordings"]

    def recording(self, robot: str, file: str, to: str | Path) -> Path:
        """Fetches one recording as MCAP into a new file."""
        content = self.connection.request("GET", f"/api/v1/recordings/{robot}/{file}", timeout_s=300.0)
        path = Path(to)
        with path.open("xb") as out:
            out.write(content)
        return path

    def stop(self, emergency: bool = False) -> None:
        """Stops every robot. Anyone may."""
        self.connection.request("POST", "/api/v1/stop", {"emergency": emergency})


class Robot:
    """One robot of a server. Looking needs no lease."""

    def __init__(self, connection: Connection, id: str) -> None:
        self.connection = connection
        self.id = id

    def state(self) -> dict[str, Any]:
        """Last `sample`, `link` and `guard`; None where nothing was heard yet."""
        return self.connection.request("GET", robot_path(self.id, "state"))

    def events(self, rate_hz: float | None = None) -> Iterator[dict[str, Any]]:
        """Everything that is told of it, until the connection ends; at most `rate_hz` samples a second."""
        url = self.connection.stream_url(self.id, rate_hz)
        with open_socket(
            url,
            additional_headers=self.connection.headers(),
            ssl=self.connection.context,
            compression=None,
            max_size=None,
        ) as socket:
            for message in socket:
                yield json.loads(message)

    def samples(self, rate_hz: float | None = None, seconds: float | None = None) -> Iterator[dict[str, Any]]:
        """Samples as they come: `time_s` of the controller, `q_rad`, `moving`, …; for so many seconds of this machine's clock."""
        end_s = None if seconds is None else time.monotonic() + seconds
        for event in self.events(rate_hz):
            if end_s is not None and time.monotonic() > end_s:
                return
            if event["type"] == "sample":
                yield event

    def lease(self, who: str = "python", expires_s: float = 30.0) -> Lease:
        """Takes the lease: one commands, anyone may stop."""
        body = {"who": who, "expires_s": expires_s}
        return Lease(self, self.connection.request("POST", robot_path(self.id, "lease"), body)["lease"])

    def stop(self, emergency: bool = False) -> None:
        self.connection.request("POST", robot_path(self.id, "stop"), {"emergency": emergency})

    def hold(self) -> None:
        """Stops it and keeps the place of its production, to take over by hand. Anyone may."""
        self.connection.request("POST", robot_path(self.id, "production/hold"))

    def close(self) -> None:
        self.connection.request("DELETE", robot_path(self.id))


class Lease:
    """The right to command one robot, given back at the end of `with`."""

    def __init__(self, robot: Robot, token: str) -> None:
        self.robot = robot
        self.token = token

    def _post(self, act: str, body: Any = None, timeout_s: float | None = 30.0) -> None:
        self.robot.connection.request("POST", robot_path(self.robot.id, act), body, self.token, timeout_s)

    def connect(self) -> None:
        self._post("connect")

    def disconnect(self) -> None:
        self._post("disconnect")

    def confirm(self) -> None:
        """A person's word that motion is wanted again after a lost link."""
        self._post("confirm")

    def reset(self) -> None:
        self._post("reset")

    def speed(self, percent: float) -> None:
        self._post("speed", {"percent": percent})

    def move(self, q_rad: Sequence[float]) -> None:
        """Moves to joint angles [rad] and returns when it stands there. Raises Refused or Stopped with the reason.

        Interrupting the call stops the robot.
        """
        self._post("move", {"q_rad": [float(q) for q in q_rad]}, None)

    def run(self, program: Any, as_text: bool = False, despite: Sequence[str] = ()) -> None:
        """Checks a program, runs it and returns at its end.

        A program whose check is red is refused; `despite` names the codes of findings you have seen and go on in spite of.
        """
        self._post("run", {"program": program, "asText": as_text, "despite": list(despite)}, None)

    def produce(self, program: Any, cycles: int | None = None, breakpoints: Sequence[str] = ()) -> None:
        """Runs a program cycle after cycle, for ever without `cycles`, and returns at the end."""
        body = {"program": program, "cycles": cycles, "breakpoints": list(breakpoints)}
        self._post("production", body, None)

    def replace(self, program: Any) -> None:
        """Another program from the next cycle on, without a stop; returns when it has taken over."""
        path = robot_path(self.robot.id, "production/program")
        self.robot.connection.request("PUT", path, {"program": program}, self.token, None)

    def resume(self, at: str = "step") -> None:
        """Hands back to a held production, from where the robot stands: its "step", or a "cycle" from its beginning."""
        self._post("production/resume", {"from": at})

    def step(self) -> None:
        """One step of a held production."""
        self._post("production/step")

    def release(self) -> None:
        self.robot.connection.request("DELETE", robot_path(self.robot.id, "lease"), lease=self.token)

    def __enter__(self) -> Lease:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()
