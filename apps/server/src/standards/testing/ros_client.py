"""roslibpy against the rosbridge port: sys.argv[1]. Says what it got as JSON lines; goals come from stdin."""
import json, sys, threading, time
import roslibpy

ros = roslibpy.Ros(host="127.0.0.1", port=int(sys.argv[1]))
ros.run(10)

def once(topic, kind, **options):
    got, event = [], threading.Event()
    t = roslibpy.Topic(ros, topic, kind, **options)
    t.subscribe(lambda m: (got.append(m), event.set()))
    assert event.wait(10), topic
    t.unsubscribe()
    return got[0]

js = once("/joint_states", "sensor_msgs/msg/JointState")
old = once("/arm/joint_states", "sensor_msgs/JointState")
print(json.dumps({
    "joints": js, "ros1": sorted(old["header"]["stamp"]), "tf": once("/tf", "tf2_msgs/msg/TFMessage"),
    "urdf": once("/robot_description", "std_msgs/msg/String")["data"][:200], "topics": sorted(ros.get_topics()),
}))
n = []
t = roslibpy.Topic(ros, "/joint_states", "sensor_msgs/msg/JointState", throttle_rate=100)
t.subscribe(lambda m: n.append(time.monotonic())); time.sleep(2); t.unsubscribe()
print(json.dumps({"throttled_Hz": (len(n) - 1) / (n[-1] - n[0])}))
heard, event = [], threading.Event()
chat = roslibpy.Topic(ros, "/chatter", "std_msgs/String")
chat.subscribe(lambda m: (heard.append(m["data"]), event.set())); chat.advertise(); time.sleep(0.2)
chat.publish(roslibpy.Message({"data": "hello"})); event.wait(5)
try:
    roslibpy.Service(ros, "/none", "x").call(roslibpy.ServiceRequest({}), timeout=5); failed = "no error"
except Exception as problem:
    failed = str(problem)
print(json.dumps({"heard": heard, "failed": failed}))

client = roslibpy.ActionClient(ros, "/arm/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory")
for line in sys.stdin:
    ask = json.loads(line)
    ended, feedback = threading.Event(), []
    out = {}
    def result(r): out["result"] = r; ended.set()
    def error(r): out["error"] = r; ended.set()
    goal = client.send_goal(roslibpy.Goal(ask["goal"]), result, feedback.append, error)
    if ask.get("cancel_s") is not None: time.sleep(ask["cancel_s"]); client.cancel_goal(goal)
    if ask.get("stop_s") is not None: time.sleep(ask["stop_s"]); roslibpy.Service(ros, "/arm/stop", "std_srvs/srv/Trigger").call(roslibpy.ServiceRequest({}), timeout=5)
    if ask.get("leave_s") is not None: time.sleep(ask["leave_s"]); ros.close(); time.sleep(0.5); break
    ended.wait(30)
    print(json.dumps({"out": out, "feedback": len(feedback)}, default=lambda v: dict(v) if hasattr(v, "keys") else str(v)))
print(json.dumps({"bye": True}), flush=True)
import os; os._exit(0)
