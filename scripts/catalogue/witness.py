"""Writes fixtures/kinematics/catalogue-fk.json: poses of the flange of the catalogue's arms by programs that are not this project's.

pip install pin xacro numpy; python scripts/catalogue/witness.py FOLDER, with the same checkouts as write.ts, after it: frames.json
names base and tip of every arm. The descriptions are expanded by xacro and computed by pinocchio. Right angles that a description
rounds (1.5708) are made exact, as in the data.
"""
import glob
import json
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import numpy
import pinocchio
import xacro
import xacro.substitution_args as substitution

SEED = 20261123
SAMPLES = 5
SLACK_RAD = 1e-3
HERE = os.path.dirname(os.path.abspath(__file__))
folder = os.path.abspath(sys.argv[1])
packages = {}
for path in sorted(glob.glob(folder + "/*/**/package.xml", recursive=True)):
    place = os.path.dirname(path)
    for name in {os.path.basename(place), ElementTree.parse(path).getroot().findtext("name").strip()}:
        packages.setdefault(name, []).append(place)
current = folder


def find(name):
    places = packages[name]
    return next((place for place in places if place.startswith(current)), places[0])


substitution._eval_find = find


def exact(text):
    values = []
    for value in map(float, text.split()):
        whole = round(value / (math.pi / 2)) * (math.pi / 2)
        values.append(whole if abs(value - whole) < SLACK_RAD else value)
    return " ".join(map(repr, values))


def urdf_of(robot):
    """The file as links and joints alone, without shapes and masses."""
    global current
    current = folder + "/" + robot["repository"].replace("/", "+")
    path = current + "/" + robot["path"]
    text = xacro.process_file(path, mappings=robot.get("args", {})).toxml() if path.endswith(".xacro") else open(path).read()
    root = ElementTree.fromstring(text)
    for link in root.findall("link"):
        for part in list(link):
            link.remove(part)
    for other in [child for child in root if child.tag not in ("link", "joint")]:
        root.remove(other)
    for joint in root.findall("joint"):
        for mimic in joint.findall("mimic"):
            joint.remove(mimic)
        if joint.get("type") == "continuous":
            joint.set("type", "revolute")
            limit = joint.find("limit")
            if limit is None:
                limit = ElementTree.SubElement(joint, "limit", velocity="1", effort="1")
            limit.set("lower", "-3.14")
            limit.set("upper", "3.14")
        origin = joint.find("origin")
        if origin is not None and origin.get("rpy"):
            origin.set("rpy", exact(origin.get("rpy")))
    return root


def case_of(robot, random):
    root = urdf_of(robot)
    up = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
    model = pinocchio.buildModelFromXML(ElementTree.tostring(root, encoding="unicode"))
    data = model.createData()
    base, tip = robot["frames"]
    moving, link = [], tip
    while link != base:
        joint = up[link]
        if joint.get("type") != "fixed":
            moving.append(joint)
        link = joint.find("parent").get("link")
    moving.reverse()
    samples = []
    for _ in range(SAMPLES):
        q, values = pinocchio.neutral(model), []
        for joint in moving:
            limit = joint.find("limit")
            value = float(random.uniform(float(limit.get("lower")), float(limit.get("upper"))))
            q[model.joints[model.getJointId(joint.get("name"))].idx_q] = value
            values.append(value)
        pinocchio.framesForwardKinematics(model, data, q)
        body = pinocchio.FrameType.BODY
        pose = data.oMf[model.getFrameId(base, body)].inverse() * data.oMf[model.getFrameId(tip, body)]
        samples.append({"q": values, "T": [[float(value) for value in row] for row in pose.homogeneous[:3]]})
    return {"joints": [joint.get("name") for joint in moving], "samples": samples}


frames = json.load(open(HERE + "/frames.json"))
robots = json.load(open(HERE + "/descriptions.json"))["robots"]
random = numpy.random.default_rng(SEED)
about = {
    "about": "Flange poses of the arms of the catalogue, base link to tip: T is the upper 3 × 4 of the homogeneous matrix.",
    "units": "m, rad",
    "generator": f"scripts/catalogue/witness.py, pinocchio {pinocchio.__version__}, xacro",
    "seed": SEED,
}
cases = {robot["id"]: case_of({**robot, "frames": frames[robot["id"]]}, random) for robot in robots if not robot.get("unverified")}
with open(HERE + "/../../fixtures/kinematics/catalogue-fk.json", "w") as file:
    file.write("{\n")
    file.write("".join(f"{json.dumps(key)}: {json.dumps(value, ensure_ascii=False)},\n" for key, value in about.items()))
    file.write('"robots": {\n')
    file.write(",\n".join(f"{json.dumps(key)}: {json.dumps(value)}" for key, value in cases.items()))
    file.write("\n}\n}\n")
print(len(cases), "robots")
