"""Random nonlinear systems with disturbances, the same for the same seed; run as a script, verifies the results of many.

A line of JSON for each, then how many got which verdict. Fails if one is called wrong, or a tenth is not confirmed.
"""

import argparse
import collections
import json
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tempfile


def _term(rng, names, disturbances):
    a, b = rng.choice(names), rng.choice(names)
    w = rng.choice(disturbances)
    c = round(rng.uniform(-1, 1), 2)
    return rng.choice(
        [f"{c}*{a}", f"{c}*{a}*{b}", f"{c}*{a}^2", f"{c}*{a}^3", f"{c}*sin({a})", f"{c}*cos({a})*{b}",
         f"{c}*abs({a})", f"{c}*{a}*abs({b})", f"{c}*max({a}, {b})", f"{c}*min({a}, {b}^2)", f"{c}*tanh({a})",
         f"{c}*exp(-{a}^2)", f"{c}*{a}/(1 + {b}^2)", f"{c}*sqrt(1 + {a}^2)", f"{c}*{a}*{w}", f"{c}*atan({a})",
         f"{c}*{w}", f"{c}*{w}^2", f"{c}*sin({a} + {w})"]
    )  # fmt: skip


def random_system(seed):
    """A spec of one to three states, mostly in continuous time."""
    rng = random.Random(seed)
    names = ["x", "y", "z"][: rng.choice([1, 2, 2, 2, 3])]
    disturbances = ["d", "e"][: rng.choice([1, 1, 2])]
    cells = {1: 60, 2: 16, 3: 6}[len(names)]
    states = []
    for name in names:
        half = rng.choice([1, 2, 3])
        outside = rng.choice(["unsafe", "saturate", "safe"])
        states.append(
            {"name": name, "lower": -half, "upper": half, "step": round(2 * half / cells, 3), "outside": outside}
        )
    equations = {}
    discrete = rng.random() < 0.2
    for k, name in enumerate(names):
        terms = [_term(rng, names, disturbances) for _ in range(rng.randint(1, 3))]
        if discrete:
            terms.append(f"{round(rng.uniform(0.2, 0.9), 2)}*{name}")
        if k == 0:
            terms += ["u", f"{round(rng.uniform(0.1, 1), 2)}*d"]
        equations[name] = " + ".join(terms)
    return {
        "coordreq": 1,
        "name": f"random{seed}",
        "states": states,
        "inputs": [{"name": "u", "values": [-1, 0, 1][: rng.choice([2, 3])]}],
        "disturbances": [{"name": name, "lower": -w, "upper": w}
                         for name in disturbances for w in [rng.choice([0.02, 0.05, 0.1, 0.2, 0.5])]],
        "agents": [{"name": "one", "inputs": ["u"]}],
        "dynamics": {"time": "discrete" if discrete else "continuous",
                     "period": 1 if discrete else rng.choice([0.05, 0.1, 0.2, 0.5]), "equations": equations},
        "safe": " and ".join(f"{name}^2 <= {round(rng.uniform(0.5, 4), 2)}" for name in names),
        "abstraction": {"cells": rng.choice(["closed", "half_open"])},
    }  # fmt: skip


def random_team(rng, name):
    """Two to four agents that move by integrators, with whatever can be asked of them."""
    agents = rng.choice([2, 2, 3, 4])
    points = rng.choice({2: [20, 60, 150, 301], 3: [9, 20, 41], 4: [5, 9, 13]}[agents])
    values = rng.choice([[-1, 0, 1], [-2, -1, 0, 1, 2], [0, 1]])
    names = [f"x{i}" for i in range(agents)]
    continuous = rng.random() < 0.4
    step = rng.choice([1, 1, 0.5])
    spec = {
        "coordreq": 1,
        "name": name,
        "states": [{"name": x, "lower": 0, "upper": points - 1, "step": 1,
                    "outside": rng.choice(["unsafe", "unsafe", "saturate", "safe"])} for x in names],
        "inputs": [{"name": f"u{i}", "values": values} for i in range(agents)],
        "agents": [{"name": f"a{i}", "inputs": [f"u{i}"]} for i in range(agents)],
        "dynamics": {"time": "continuous" if continuous else "discrete", "period": 1 if continuous else 2,
                     "equations": {x: f"{step}*u{i}" if continuous else f"{x} + {step}*u{i}"
                                   for i, x in enumerate(names)}},
        "safe": " + ".join(f"({x} - {points // 2})^2" for x in names)
                + f" <= {round(rng.uniform(0.1, 0.4) * points ** 2)}",
        "abstraction": {"cells": rng.choice(["closed", "half_open"]),
                        "between_samples": continuous and rng.random() < 0.3},
        "controller": {"synthesis": rng.choice(["maximal", "maximal", "maximal", "given"])},
        "coordination": {},
        "output": {key: rng.random() < 0.3 for key in ("controller", "actions", "layers", "abstraction")},
    }  # fmt: skip
    coordination = spec["coordination"]
    if rng.random() < 0.5:
        coordination["partitions"] = "all"
    if rng.random() < 0.3:
        coordination["horizon"] = rng.randint(1, 5)
    if rng.random() < 0.3:
        coordination["convention"] = True
    if rng.random() < 0.2:
        coordination["max_delay"] = rng.randint(5, 20)
    if rng.random() < 0.3:
        spec["network"] = {"weakly_hard": {"misses": 1, "window": rng.randint(2, 4)}, "resynthesise": rng.random() < 0.5}
    if rng.random() < 0.3:
        spec["controller"]["allow"] = f"{names[0]} + u0 >= 0"
    if rng.random() < 0.4:
        spec["requirements"] = [
            {"name": str(r), "where": f"{names[0]} <= {rng.randint(1, points // 2)}", "invariant": True}
            for r in range(rng.choice([1, 10, 500]))
        ]
    return spec


def random_analysis(seed):
    """A spec of any kind: a random system, or a team of agents."""
    rng = random.Random(seed)
    if rng.random() < 0.7:
        return random_team(rng, f"team{seed}")
    spec = random_system(seed)
    for state in spec["states"]:
        half, cells = state["upper"], {1: 20000, 2: 100, 3: 20}[len(spec["states"])]
        state["step"] = round(2 * half / rng.choice([cells, cells // 2]), 4)
    return spec


def timed(command):
    """What a command said, and the seconds of all processors that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return result, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def outcome(program, seed, folder, *arguments):
    """What analyze and verify say of a random system: verdict, sets confirmed and asked about, seconds of each."""
    spec, results = folder / f"{seed}.json", folder / f"{seed}.h5"
    spec.write_text(json.dumps(random_system(seed)))
    analysis, analysis_seconds = timed([program, "analyze", spec, "-o", results, "--json"])
    if analysis.returncode != 0:
        return {"seed": seed, "verdict": "refused", "why": analysis.stderr.strip()}
    command = [program, "verify", results, "--json", *arguments]
    verification, seconds = timed(command)
    results.unlink()
    if not verification.stdout:
        return {"seed": seed, "verdict": "failed", "why": verification.stderr.strip()}
    summary = json.loads(verification.stdout)
    return {
        "seed": seed,
        "verdict": summary["verdict"],
        "confirmed": summary["confirmed"],
        "analysis": round(analysis_seconds, 2),
        "seconds": round(seconds, 2),
        "why": [text for check in summary["checks"] for text in check["examples"] + check["doubts"]],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--verify", default="", help="arguments of verify, such as '--budget 10'")
    options = parser.parse_args()
    verdicts = collections.Counter()
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(options.first, options.first + options.count):
            found = outcome(options.program, seed, pathlib.Path(folder), *options.verify.split())
            verdicts[found["verdict"]] += 1
            if "seconds" in found:
                seconds.append(found["seconds"])
            print(json.dumps(found), flush=True)
    seconds.sort()
    print(dict(verdicts), f"verify: median {statistics.median(seconds):.2f} s, slowest {seconds[-1]:.1f} s")
    accepted = sum(verdicts.values()) - verdicts["refused"]
    return 1 if verdicts["wrong"] + verdicts["failed"] > 0 or verdicts["holds"] < 0.9 * accepted else 0


if __name__ == "__main__":
    sys.exit(main())
