"""Random nonlinear systems with disturbances, the same for the same seed."""

import random


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
