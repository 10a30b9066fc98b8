#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files of the programs against the schemas in share/schemas.
usage: schemas_of_programs.py TREE BIN WORK
Runs programs of BIN on a small simulated site, with files in the new folder WORK, and validates
every JSON file that they write. Then removes each required key and gives each value a wrong type,
one at a time, and requires that every such damage is found. Exit code 1: a fault; 77: the Python
module jsonschema is missing.
"""
import copy
import pathlib
import shutil
import subprocess
import sys

from schemas import faults_of, read_json, read_schemas, schema_of, validator_of

# Exit code 3 is a doubtful result, which is written as well.
STEPS = """
pcl_slam6d_simulate rooms -o site --scans 8 --resolution 1 --seed 3 --people 1
pcl_slam6d_simulate corridor -o drive --scans 4 --resolution 4 --motion continuous
pcl_slam6d_simulate intrude drive -o intruded --people 1
pcl_slam6d site -o run --last 5 --planes --no-picture --control control.csv --targets targets.csv
pcl_slam6d site -o again --last 3 --no-picture
pcl_slam6d drive -o deskewed --deskew estimate --no-picture
pcl_slam6d_planes again -o planes --refine
pcl_slam6d_objects locate again -o objects --store MODELS
pcl_slam6d_semantic_map build again --objects objects/objects.json --planes planes/planes.json
pcl_slam6d_localize again site -o localized --first 4
pcl_slam6d_evaluate verify again -o verified
pcl_slam6d_evaluate changes again run -o changed --given
pcl_slam6d_evaluate mcl site --map site/planes_truth.json --reference site/groundtruth.txt -o mcl
pcl_slam6d_evaluate icp site/scan000.pcd site/scan001.pcd --steps-xy 3 --steps-yaw 1 -o icp
pcl_slam6d_evaluate suite suite_file.json -o suite
pcl_slam6d_evaluate suite trust_file.json -o trust
pcl_slam6d_evaluate trajectory again/trajectory.tum site/groundtruth.txt -o free/trajectory.json
pcl_slam6d_evaluate lengths lengths.txt -o free/lengths.json
pcl_slam6d_evaluate map again -o free/map_quality.json
pcl_slam6d_evaluate place site/scan000.pcd site/scan001.pcd -o free/place.json
pcl_slam6d_evaluate place site/scan004.pcd again -o free_run/place.json
pcl_slam6d_doctor drive/scan000.pcd drive/scan001.pcd --json free/doctor.json
"""
QUERY = "pcl_slam6d_semantic_map query again planes --json"
# Keys whose values have no fixed form.
FREE = ("inputs", "description")
SUITE = """{"schema_version": 1, "time_limit": 60, %s
 "data": {"corridor": {"simulate": {"scene": "corridor", "scans": 3, "resolution": 4}}},
 "methods": {"defaults": {}}}
"""


def run(folder, programs, line, models=""):
    """Runs a program with its arguments in a folder; returns its standard output."""
    program, *arguments = line.split()
    words = [str(models) if word == "MODELS" else word for word in arguments]
    done = subprocess.run([programs / program, *words], cwd=folder, capture_output=True, text=True,
                          check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{line}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def write_control(folder):
    """Four control points, and their places in each scan of `run` by the true poses."""
    points = [(4, 3, 1), (-5, 2, 0), (1, -6, 2), (6, -4, -1)]
    targets = []
    for scan, line in enumerate((folder / "site/groundtruth.txt").read_text().splitlines()[:6]):
        row = [float(word) for word in line.split()]
        for number, point in enumerate(points):
            shift = [point[k] - row[4 * k + 3] for k in range(3)]
            inside = [sum(row[4 * k + axis] * shift[k] for k in range(3)) for axis in range(3)]
            targets.append(f"T{number} {scan} {inside[0]} {inside[1]} {inside[2]}\n")
    (folder / "control.csv").write_text(
        "".join(f"T{number} {x} {y} {z}\n" for number, (x, y, z) in enumerate(points)))
    (folder / "targets.csv").write_text("".join(targets))


def write_inputs(folder):
    """The files that the steps read, except those of the simulator."""
    (folder / "free").mkdir()
    (folder / "free_run").mkdir()
    (folder / "lengths.txt").write_text("1 2\n2 4.1\n3 6\n")
    (folder / "suite_file.json").write_text(SUITE % "")
    (folder / "trust_file.json").write_text(SUITE % '"table": "trust",')


def damaged(value, place=()):
    """(place, damaged copy) for each value inside an object, with a value of a wrong type."""
    if isinstance(value, dict):
        for key in value:
            yield place + (key,), {**value, key: [[]]}
            if key not in FREE:
                for inner, copied in damaged(value[key], place + (key,)):
                    yield inner, {**value, key: copied}
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for inner, copied in damaged(value[0], place + (0,)):
            yield inner, [copied] + value[1:]


def shortened(value):
    """A copy in which lists of objects hold the first one only: damaged() damages no other."""
    if isinstance(value, dict):
        return {key: shortened(inner) for key, inner in value.items()}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [shortened(value[0])]
    return value


def undetected(schema, value):
    """For each damage what the schema fails to find; empty: it is found."""
    is_valid = validator_of(schema).is_valid
    if is_valid(shortened(value)):
        value = shortened(value)
    for key in schema["required"]:
        without = copy.copy(value)
        del without[key]
        yield f"{key} may be missing" if is_valid(without) else ""
    yield "an unknown key is accepted" if is_valid({**value, "unknown_key": 1}) else ""
    for place, copied in damaged(value):
        yield "/".join(map(str, place)) + " may have any type" if is_valid(copied) else ""


def check(schemas, folder):
    """Prints the faults of all files; returns their number, the schemas in use, and the number of
    damages."""
    count, used, num_damages = 0, set(), 0
    for path in sorted(folder.rglob("*.json")):
        if path.name.endswith("_file.json"):
            continue
        faults = faults_of(schemas, path)
        value = read_json(path)
        name = schema_of(path, value)
        if not faults and name not in used:
            damages = list(undetected(schemas[name], value))
            num_damages += len(damages)
            faults = [f"{path}: {name}: {fault}" for fault in damages if fault]
        used.add(name)
        print(*faults, sep="\n", end="\n" if faults else "")
        count += len(faults)
    return count, used, num_damages


def main():
    """Runs the steps, validates, damages."""
    tree, programs, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    write_inputs(work)
    for number, line in enumerate(STEPS.strip().splitlines()):
        run(work, programs, line, tree / "share/models")
        if number == 0:
            write_control(work)
    (work / "free/query.json").write_text(run(work, programs, QUERY))
    schemas = read_schemas(tree)
    faults, used, num_damages = check(schemas, work)
    unused = sorted(set(schemas) - used - {"training"})
    print(f"{len(used)} of {len(schemas)} schemas used, {num_damages} damages, {faults} faults", *unused)
    sys.exit(1 if faults or unused else 0)


if __name__ == "__main__":
    main()
