"""Requests by HTTP, and what goes wrong with them."""

from __future__ import annotations

import http.client
import json
import ssl
from typing import Any, Mapping
from urllib.parse import quote, urlencode, urlsplit


class ApiError(Exception):
    """Something was not done. `code` is for programs, the text for people, `hint` is the way out."""

    def __init__(self, code: str, sentence: str, hint: str, status: int) -> None:
        super().__init__(f"{sentence} {hint}".strip())
        self.code = code
        self.sentence = sentence
        self.hint = hint
        self.status = status


class Refused(ApiError):
    """Nothing was done."""


class Stopped(ApiError):
    """It was begun and stopped on the way."""


class Unreachable(ApiError):
    """No answer came. A motion that was under way is stopped by the server."""


class Connection:
    """One address, its token, and requests to it. Every request has a connection of its own: ending it stops the motion it asked for."""

    def __init__(self, url: str, token: str | None = None, context: ssl.SSLContext | None = None) -> None:
        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or parts.hostname is None:
            raise ValueError(f"{url!r} is no address such as http://127.0.0.1:7341.")
        self.secure = parts.scheme == "https"
        self.host = parts.hostname
        self.port = parts.port or (443 if self.secure else 80)
        self.token = token
        self.context = context

    def headers(self) -> dict[str, str]:
        return {} if self.token is None else {"authorization": f"Bearer {self.token}"}

    def stream_url(self, robot: str, rate_hz: float | None) -> str:
        query: dict[str, str] = {"robot": robot}
        if rate_hz is not None:
            query["rate_Hz"] = repr(float(rate_hz))
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{'wss' if self.secure else 'ws'}://{host}:{self.port}/api/v1/stream?{urlencode(query)}"

    def request(
        self, method: str, path: str, body: Any = None, lease: str | None = None, timeout_s: float | None = 30.0
    ) -> Any:
        """The JSON of the answer, bytes of another one.

        Raises Refused, Stopped, or Unreachable when no answer comes; `timeout_s` None waits for as long as a motion takes.
        """
        headers = self.headers()
        if lease is not None:
            headers["twincell-lease"] = lease
        data = None
        if body is not None:
            headers["content-type"] = "application/json"
            data = json.dumps(body, allow_nan=False).encode()
        connection: http.client.HTTPConnection = (
            http.client.HTTPSConnection(self.host, self.port, timeout=timeout_s, context=self.context)
            if self.secure
            else http.client.HTTPConnection(self.host, self.port, timeout=timeout_s)
        )
        try:
            connection.request(method, path, data, headers)
            response = connection.getresponse()
            content = response.read()
            status = response.status
            is_json = response.getheader("content-type", "").startswith("application/json")
        except (OSError, http.client.HTTPException) as problem:
            where = f"{self.host}:{self.port}"
            raise Unreachable("host.gone", f"{where} gave no answer: {problem}.", "Is the server running?", 0) from problem
        finally:
            connection.close()
        value: Any = json.loads(content) if is_json else content
        if status == 200:
            return value
        why: Mapping[str, Any] = value.get("why", {}) if isinstance(value, dict) else {}
        kind = Stopped if isinstance(value, dict) and value.get("kind") == "stopped" else Refused
        raise kind(
            str(why.get("code", "api.status")),
            str(why.get("sentence", f"The server answered {status}.")),
            str(why.get("hint", "")),
            status,
        )


def robot_path(robot: str, act: str = "") -> str:
    return f"/api/v1/robots/{quote(robot, safe='')}{'/' + act if act else ''}"


def judged(program: Any, model: str | None, cell: Any, **more: Any) -> dict[str, Any]:
    """The body of a question about a program, without what was left out."""
    given = {"program": program, "model": model, "cell": cell, **more}
    return {name: value for name, value in given.items() if value is not None}
