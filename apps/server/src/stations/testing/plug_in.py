"""A maker's driver as a process of its own: Python's standard library, a pretend arm, and the messages of docs/controllers/plug-in.md.

    python3 plug_in.py PORT ROBOT JOINTS [LOG]

Says the port it listens on. LOG takes down every line of the session as it is, "> " before what came and "< " before what went.
"""
import json
import select
import socket
import sys
import time

PORT, ROBOT, JOINTS = int(sys.argv[1]), sys.argv[2], int(sys.argv[3])
LOG = open(sys.argv[4], "a", encoding="utf-8") if len(sys.argv) > 4 else None
CYCLE_S, SILENCE_S, SPEED_RAD_S = 0.02, 0.5, 1.0
WORDS = {"id": "robot", "name": "Pretend arm", "brand": "pretend", "robot": ROBOT, "virtual": False, "watchdog": "Stops after 500 ms of silence."}


def why(code, sentence):
    return {"code": code, "sentence": sentence, "hint": "Command it again."}


class Arm:
    """Joints that go straight to their targets. What makes it a product stays in here."""

    def __init__(self):
        self.q, self.target, self.ratio, self.override, self.asked, self.off = [0.0] * JOINTS, None, 1.0, 1.0, None, False

    def step(self):
        """One cycle; what a motion that ended came to, or None."""
        if self.target is None:
            return None
        most = SPEED_RAD_S * self.ratio * self.override * CYCLE_S
        far = max(abs(t - q) for q, t in zip(self.q, self.target))
        if far <= most:
            self.q, self.target = list(self.target), None
            return {"kind": "done"}
        self.q = [q + (t - q) * most / far for q, t in zip(self.q, self.target)]
        return None


class Session:
    def __init__(self, line, arm):
        self.line, self.arm, self.rest, self.sequence, self.open, self.alive_s = line, arm, b"", 0, False, time.monotonic()
        self.tell({"type": "hello", "protocol": 2, "version": "1.0", "brands": [], "stations": []})

    def tell(self, message):
        text = json.dumps(message, separators=(",", ":"))
        if LOG:
            LOG.write("< " + text + "\n")
            LOG.flush()
        self.line.sendall(text.encode() + b"\n")

    def answer(self, number, outcome):
        self.tell({"type": "answer", "id": number, "outcome": outcome})

    def end_motion(self, outcome):
        self.arm.target, number, self.arm.asked = None, self.arm.asked, None
        if number is not None:
            self.answer(number, outcome)

    def hear(self, ask):
        kind, arm = ask["type"], self.arm
        self.alive_s = time.monotonic()
        if kind == "alive":
            return
        if kind == "ping":
            self.tell({"type": "pong", "sent_s": ask["sent_s"], "host_s": time.monotonic()})
        elif kind == "stop":
            arm.off = arm.off or ask["emergency"]
            self.end_motion({"kind": "stopped", "why": why("pretend.stopped", "The pretend arm was stopped.")})
        elif kind == "run":
            self.run(ask["id"], ask["program"]["steps"][0])
        elif kind in ("open", "connect", "take", "speed", "reset"):
            if kind == "open":
                self.tell({"type": "opened", **WORDS})
                self.open = True
            if kind == "speed":
                arm.override = ask["percent"] / 100
            if kind == "reset":
                arm.off = False
            self.answer(ask["id"], {"kind": "done"})
        else:
            self.answer(ask["id"], {"kind": "refused", "why": why("pretend.unknown", "The pretend arm cannot " + kind + ".")})

    def run(self, number, step):
        arm = self.arm
        if step["type"] != "move" or "q" not in step["target"]:
            self.answer(number, {"kind": "refused", "why": why("pretend.step", "The pretend arm only moves its joints.")})
        elif arm.target is not None or arm.off:
            self.answer(number, {"kind": "refused", "why": why("pretend.busy", "The pretend arm is moving, or its drives are off.")})
        else:
            arm.target, arm.ratio, arm.asked = step["target"]["q"], step["speed"]["ratio"], number

    def cycle(self):
        if time.monotonic() - self.alive_s > SILENCE_S:
            self.end_motion({"kind": "stopped", "why": why("pretend.silence", "Nobody gave a sign of life.")})
        moving, ended = self.arm.target is not None, self.arm.step()
        if ended:
            self.end_motion(ended)
        if self.open:
            self.sequence += 1
            self.tell({
                "type": "sample", "station": "robot", "sequence": self.sequence, "time_s": time.monotonic(), "sent_s": time.monotonic(), "q_rad": self.arm.q,
                "moving": moving and not ended, "mode": "remote", "safety": "emergency-stop" if self.arm.off else "normal", "override": self.arm.override,
                "gripperClosed": False, "step": "", "message": "", "plan_rad": None, "command_rad": None,
            })


def serve():
    listener = socket.socket()
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.bind(("127.0.0.1", PORT))
    listener.listen()
    print(listener.getsockname()[1], flush=True)
    arm = Arm()
    while True:
        line, _ = listener.accept()
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            talk(line, arm)
        except OSError:
            pass  # Whoever commanded is gone; the arm stands, and the next one is waited for.
        arm.target = arm.asked = None
        line.close()


def talk(line, arm):
    session, due_s = Session(line, arm), time.monotonic()
    while True:
        ready, _, _ = select.select([line], [], [], max(0.0, due_s - time.monotonic()))
        if ready:
            came = line.recv(65536)
            if not came:
                return
            *texts, session.rest = (session.rest + came).split(b"\n")
            for text in texts:
                if LOG:
                    LOG.write("> " + text.decode() + "\n")
                session.hear(json.loads(text))
        if time.monotonic() >= due_s:
            session.cycle()
            due_s = max(due_s + CYCLE_S, time.monotonic())


serve()
