"""Client of a Twincell server. SI units and radians; joints count from 1. Not a certified safety device."""

from ._asyncio import AsyncLease, AsyncRobot, AsyncServer
from ._frame import frame
from ._http import ApiError, Refused, Stopped, Unreachable
from ._sync import Lease, Robot, Server

__all__ = [
    "ApiError",
    "AsyncLease",
    "AsyncRobot",
    "AsyncServer",
    "Lease",
    "Refused",
    "Robot",
    "Server",
    "Stopped",
    "Unreachable",
    "frame",
]
