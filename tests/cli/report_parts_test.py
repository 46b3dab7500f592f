"""What `coordreq report` shows of files with requirements, coalitions, networks and conventions, in a browser."""

import json
import re
import unittest

import h5py
from browser import Browser
from program import SPEC, spec_with
from report_case import PageCase, data_of, unpacked

TWO_MODES = {"modes": [{"name": "up", "partition": "a+b"}, {"name": "down", "partition": "a|b"}],
             "transitions": [["up", "up"], ["up", "down"], ["down", "up"]]}  # fmt: skip


class Cases(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def show(self, kind):
        """The pictures of a kind, chosen with the keyboard."""
        kinds = self.browser.run("[...document.querySelectorAll('#kinds input')].map((radio) => radio.value)")
        self.focus("#kinds input:checked")
        shown = kinds.index(self.browser.run("document.querySelector('#kinds input:checked').value"))
        for _ in range((kinds.index(kind) - shown) % len(kinds)):
            self.browser.press("ArrowRight")
        self.assertEqual(self.browser.run("document.querySelector('#kinds input:checked').value"), kind)

    def legend(self):
        return self.browser.run("document.getElementById('legend').innerText").split("\n")

    def options(self, name="member"):
        return self.browser.run(f"[...document.getElementById('{name}').options].map((option) => option.text)")

    def assert_colours_tell_apart(self, meaning_of, places):
        """Cells have one colour if and only if they mean the same. @returns the meanings"""
        colours = {}
        for place in places:
            colour = tuple(self.point(*place))
            colours.setdefault(meaning_of(self.cell()), set()).add(colour)
        self.assertTrue(all(len(own) == 1 for own in colours.values()), colours)
        self.assertEqual(len(set().union(*colours.values())), len(colours), colours)
        return set(colours)

    PLACES = [(0.05 + 0.1 * i, 0.05 + 0.1 * j) for i in range(10) for j in range(10)]

    # coalitions

    def test_coalitions(self):
        self.report(self.example("platoon_coalition.json"))
        self.open()
        self.assertEqual(self.browser.run("document.getElementById('partition').selectedOptions[0].text"), "lead|middle|tail")
        self.show("coalition")
        kinds = ["lead|middle|tail", "lead+middle|tail", "lead|middle+tail", "lead+middle+tail", "none"]
        meanings = self.assert_colours_tell_apart(lambda cell: cell["Cheapest partition"], self.PLACES)
        self.assertEqual(meanings, set(kinds))
        self.assertEqual(self.legend(), ["lead|middle|tail (cost 0)", "lead+middle|tail (cost 1)", "lead|middle+tail (cost 1)",
                                         "lead+middle+tail (cost 2)", "not safe"])  # fmt: skip
        for place in ((0.3, 0.3), (0.3, 0.8), (0.8, 0.3), (0.8, 0.8), (0.02, 0.5)):
            self.point(*place)
            self.assert_is_answer(self.cell(), "lead|middle|tail")
        self.assertIn("hidden", self.browser.run("document.getElementById('member-field').outerHTML"))
        self.assert_is_quiet()

    def test_critical_pairs(self):
        self.report(self.example("platoon_coalition.json"))
        self.open()
        self.show("pairs")
        self.assertEqual(self.options(), ["lead+middle", "lead+tail", "middle+tail"])
        for number, pair in enumerate(self.options()):
            self.select("member", number)

            def meaning(cell, pair=pair):
                return cell["Safe set"], pair in cell["Critical pairs"].split(", ")

            self.assertEqual(len(self.assert_colours_tell_apart(meaning, self.PLACES[::3])), 3)
        self.point(0.3, 0.8)
        self.assert_is_answer(self.cell(), "lead|middle|tail")
        self.assert_is_quiet()

    def test_no_partition_suffices(self):
        spec = self.example("platoon_coalition.json")
        spec["coordination"]["partitions"] = [{"name": "alone", "classes": []}]
        text = self.words_of(self.report(spec))
        self.assertIn("Cheapest partition Cost States Share alone 0 1,024 20 % none of those listed suffices 4,160 80 %", text)
        self.open()
        self.show("coalition")
        self.point(0.3, 0.3)
        self.assertEqual(self.cell()["Cheapest partition"], "none: no partition of the file suffices")
        self.assert_is_answer(self.cell(), "alone")
        self.assertEqual(self.legend(), ["alone (cost 0)", "not safe", "no partition of the file suffices"])

    def test_figures_of_coalitions(self):
        text = self.words_of(self.report(self.example("platoon_coalition.json")))
        self.assertIn("For 8 steps (4 s) without further contact between them", text)
        self.assertIn("lead|middle|tail 0 1,024 20 % lead+middle|tail 1 1,280 25 %", text)
        self.assertIn("Critical pair States Share lead+middle 2,880 56 % lead+tail 1,600 31 % middle+tail 2,880 56 %", text)

    def test_many_partitions(self):
        """Four agents have 15: eight are in the open, those with pictures; all are in the page."""
        agents = [{"name": name, "inputs": [f"u{name}"]} for name in "abcd"]
        spec = spec_with(
            states=[{"name": f"x{name}", "lower": 0, "upper": 3, "step": 1, "outside": "saturate"} for name in "abcd"],
            inputs=[{"name": f"u{name}", "values": [-1, 0, 1]} for name in "abcd"], agents=agents,
            dynamics={"time": "discrete", "period": 1, "equations": {f"x{name}": f"x{name} + u{name}" for name in "abcd"}},
            safe="abs(xa - xb) <= 2 and abs(xb - xc) <= 2 and abs(xc - xd) <= 1",
            coordination={"partitions": "all", "horizon": 1})  # fmt: skip
        page = self.report(spec)
        text = self.words_of(page)
        self.assertIn("7 more Partition Silence Contact a+b+c+d All agents coordinate", text)
        self.assertLess(text.index("a|b|c|d The agents"), text.index("7 more"))
        self.open()
        self.assertEqual(len(self.options("partition")), 8)
        self.show("coalition")
        for place in self.PLACES[::9]:
            self.point(*place)
            self.assert_is_answer(self.cell(), "a|b|c|d")
        self.assert_is_quiet()

    # networks

    def test_modes_of_the_network(self):
        self.report(self.example("intersection_network.json"))
        self.open()
        self.show("modes")
        self.assertEqual(self.options(), ["11", "10", "01"])
        found = set()
        for number, mode in enumerate(self.options()):
            self.select("member", number)

            def meaning(cell, mode=mode):
                names = ["11", "10", "01"] if cell["Safe in"].startswith("all") else re.findall(r"\d\d", cell["Safe in"].split(":")[-1])
                return cell["Safe set"], cell["Invariance set"], mode in names

            self.assertGreaterEqual(len(self.assert_colours_tell_apart(meaning, self.PLACES[::2])), 3)
            for place in self.PLACES[::7]:
                self.point(*place)
                cell = self.cell()
                if cell["Safe in"] not in found:
                    self.assert_is_answer(cell, "first|second")
                found.add(cell["Safe in"])
        self.assertLessEqual({"no mode", "all 3 modes"}, found)
        self.focus("#sliders input")
        self.assert_picture_changes(lambda: self.browser.press("End"))
        self.point(0.3, 0.3)
        self.assertIn("v1 = 3 m/s", self.cell()["Centre"])
        self.assert_is_answer(self.cell(), "first|second")
        self.assert_is_quiet()

    def test_figures_of_the_network(self):
        text = self.words_of(self.report(self.example("intersection_network.json")))
        self.assertIn("Agents with robust re-synthesis stay safe from 81 % of the states that can be kept safe", text)
        self.assertIn("The network: at most 1 of any 3 steps lost.", text)
        self.assertIn("11 (at first) first+second 213,477 81 % 10 first|second 210,233 79 % 01 first+second 220,952 83 %", text)

    def test_more_modes_than_the_page_holds(self):
        self.report(spec_with(network={"delay": 70}))
        self.open()
        self.show("modes")
        self.assertEqual(len(self.options()), 64)
        self.point(0.5, 0.3)
        self.assertRegex(self.cell()["Safe in"], r"^(all of the first 64 modes|no mode of the first 64 modes|\d+ of the first 64 modes: .*)$")
        self.assert_is_quiet()

    # conventions

    def test_freedom_under_the_convention(self):
        self.report(dict(self.example("crossing.json"), coordination={"convention": True}))
        self.open()
        self.show("freedom")
        self.assertEqual(self.options(), ["first", "second"])
        self.assertEqual(self.legend(), ["not safe", "cannot be kept safe on this grid, even with full coordination"])
        self.assertEqual(self.browser.run("document.getElementById('scale').innerText").split(), ["0", "%", "all"])
        told = set()
        with h5py.File(self.folder / "out.h5") as file:
            for place in self.PLACES:
                self.point(*place)
                cell = self.cell()
                index = tuple(int(k) for k in re.search(r"index \((.*)\)", cell["Cell"])[1].split(", "))
                for number, agent in enumerate(("first", "second")):
                    stored = float(file["convention_freedom"][(number, *index)])
                    text = "-" if stored != stored else "all" if stored == 1 else f"{100 * stored:.4g} %"
                    self.assertEqual(cell[f"Convention: actions of {agent}"], text)
                    told.add(text)
        self.assertGreater(len(told), 2)
        self.assert_is_answer(cell, "first|second")
        self.assert_is_quiet()

    # requirements

    def test_verdicts(self):
        text = self.words_of(self.report_that_fails(self.example("intersection_requirements.json")))
        self.assertIn("1 of 3 requirements fails. Requirement Verdict Asked Where Worst state", text)
        self.assertIn("coordination keeps them apart met by all 81 states In the invariance set approaching and faster <= 2.1", text)
        self.assertIn("1.5 s of silence, slowly met by all 25 states Delay of first|second at least 3 steps (1.5 s) "
                      "approaching and faster <= 1.1 Has a delay of 3 steps (1.5 s)", text)  # fmt: skip
        self.assertIn("1.5 s of silence, fast failed in 1 of 81 states Delay of first|second at least 3 steps (1.5 s) approaching and "
                      "faster <= 2.1 p1 = -9, v1 = 2, v2 = 2, p2 = -9: has a delay of 2 steps (1 s)", text)  # fmt: skip

    def test_the_story_is_that_of_analyze(self):
        spec = self.example("intersection_requirements.json")
        text = self.words_of(self.report_that_fails(spec))
        told = self.run_program("analyze", "spec.json", "-o", "other.h5").stdout.decode()
        story = told[told.index("FAILS") :].split("\nresults in")[0]
        _, table, sentences = story.split("\n\n")
        self.assertIn(" ".join(sentences.split()), text)
        for row in table.split("\n")[1:]:
            step, *cells = row.split()
            self.assertIn(" ".join([step, "Show", *cells]), text)

    def test_the_way_in_the_picture(self):
        self.report_that_fails(self.example("intersection_requirements.json"))
        self.open()
        (way,) = data_of((self.folder / "page.html").read_text())["ways"]
        self.assertEqual((len(way["cells"]), way["independent"]), (8, 3))
        # The page opens there, so that the button leads back.
        opened = self.cell()
        self.focus("#best")
        self.assert_picture_changes(lambda: self.browser.press("Enter"))
        self.focus("button.visit")
        self.assert_picture_changes(lambda: self.visit("Enter"))
        self.assertEqual(self.cell(), opened)
        self.assertEqual(self.cell()["Centre"], "p1 = -9 m, v1 = 2 m/s, v2 = 2 m/s, p2 = -9 m")
        self.assertIn("“1.5 s of silence, fast”, 8 states", self.browser.run("document.getElementById('way').innerText"))
        self.assert_is_answer(self.cell(), "first|second")
        self.browser.run("document.querySelector('details').open = true")
        for sample, (delay, set_) in {2: ("0 steps (0 s)", "inside"), 7: ("none: the cell is not safe", "outside")}.items():
            self.focus(f"button.visit[data-sample='{sample}'][aria-label]")
            self.visit(" ")
            cell = self.cell()
            self.assertEqual((cell["Delay"], cell["Safe set"]), (delay, set_))
            self.assertIn("index ({})".format(", ".join(map(str, way["cells"][sample]))), cell["Cell"])
        self.focus("#hide-way")
        self.assert_picture_changes(lambda: self.visit("Enter"))
        self.assertTrue(self.browser.run("document.getElementById('way').hidden"))
        self.assert_is_quiet()

    def test_the_page_opens_at_what_fails(self):
        requirements = {
            "risk": {"where": "p1 <= -8 and p2 <= -8 and v1 == 1 and v2 == 1", "max_risk": 1e-9},
            "delay": {"where": "p1 <= -8 and p2 <= -8 and v1 == 1 and v2 == 1", "min_delay": 30},
            "collision_time": {"where": "p1 >= 0 and p2 >= 0", "invariant": True},
        }
        for kind, requirement in requirements.items():
            with self.subTest(kind=kind):
                spec = {**self.example("crossing_risk.json"), "requirements": [{"name": "enough", **requirement}]}
                text = self.words_of(self.report_that_fails(spec))
                self.assertLess(text.index("What is required"), text.index("How long may the agents be silent?"))
                self.open()
                self.assertEqual(self.browser.run("document.querySelector('#kinds input:checked').value"), kind)
                self.assertIn("Counterexample of “enough”", self.browser.run("document.getElementById('way').innerText"))
        # Where nothing fails the answer comes first.
        holds = {"name": "enough", "where": "-10 <= p1 <= -8 and -10 <= p2 <= -8 and v1 == 1 and v2 == 1", "max_risk": 1}
        text = self.words_of(self.report({**self.example("crossing_risk.json"), "requirements": [holds]}))
        self.assertLess(text.index("How long may the agents be silent?"), text.index("What is required"))

    def visit(self, key):
        self.browser.press(key)
        self.browser.wait_for("document.activeElement.id === 'picture'")

    def test_region_that_reaches_outside(self):
        requirements = [{"name": "everywhere", "where": "x >= 3", "invariant": True}, {"name": "in the middle", "where": "x == 2 and y == 2", "invariant": True}]
        text = self.words_of(self.report_that_fails(spec_with(requirements=requirements)))
        self.assertIn("1 of 2 requirements fails.", text)
        self.assertRegex(text, r"[Tt]he region may reach outside the domain, x above its grid")
        text = self.words_of(self.report(spec_with(requirements=requirements[1:])))
        self.assertIn("Every requirement is met.", text)

    def test_names_in_regions_are_defined_and_nothing_is_said_twice(self):
        spec = self.example("intersection_requirements.json")
        page = self.report_that_fails(spec)
        text = self.words_of(page)
        for name, meaning in spec["definitions"].items():
            self.assertEqual(text.count(f"{name} = {meaning}"), 1)
        self.assertNotIn("K = 0.2", text)  # no region asks for it
        self.assertEqual(text.count("p1 = -9, v1 = 2, v2 = 2, p2 = -9"), 1)
        # Those of which the definition of safe says so already are left out.
        spec = spec_with(definitions={"sum": "x + y"}, safe="sum <= 6",
                         requirements=[{"name": "near", "where": "sum <= 1 and x >= 0 and y >= 0", "invariant": True}])  # fmt: skip
        self.write("spec.json", spec)
        self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
        self.assertEqual(self.words_of(self.page("page.html")).count("sum = x + y"), 1)

    def test_a_page_opens_at_a_best_state_also_with_memories(self):
        remembered = spec_with(memory={"left": "previous(x <= 1)"}, safe="x + y <= 6 and not (left and x >= 3)")
        for spec in (remembered, spec_with(safe="x + y <= 6", dynamics={**SPEC["dynamics"], "equations": {"x": "x + 1 + u/4", "y": "y"}})):
            page = self.report(spec)
            data = data_of(page)
            best = data["maps"][0]["best"] or data["latest"]
            self.assertIsNotNone(best)
            self.open()
            self.assertIn("index ({})".format(", ".join(map(str, best))), self.cell()["Cell"])
        self.assertEqual((data["maps"][0]["best"], self.cell()["Invariance set"], self.cell()["Safe set"]), (None, "outside", "inside"))

    def test_all_pictures_are_those_of_the_partition_that_is_chosen(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["a", "b"]]}]
        page = self.report(spec_with(goal="x <= 1 and y <= 1", coordination={"partitions": partitions}))
        data = data_of(page)
        self.assertEqual([map["partition"] for map in data["maps"] if map["kind"] == "approach_delay"], [0, 1])
        self.open()
        self.show("approach_delay")
        title = "Silence that costs no time to the goal"
        legends, readings = [], []
        for partition, number in (("a|b", 0), ("both", 1)):
            self.select("partition", self.options("partition").index(partition))
            rows = self.browser.run("[...document.querySelectorAll('#cell th')].map((cell) => cell.innerText)")
            self.assertEqual(rows.count(title), 1)
            values = unpacked(data["sets"][0]["maps"][[map["kind"] for map in data["maps"]].index("approach_delay") + number])
            legends.append(self.legend())
            self.point(0.5, 0.5)
            readings.append(self.cell()[title])
            steps = values.reshape(5, 5)[2, 2]
            self.assertIn("unbounded" if steps > 1000 else f"({steps} step", readings[-1])
        self.assertNotEqual(*legends)
        self.assertNotEqual(*readings)

    def test_a_way_that_the_page_does_not_hold(self):
        page = self.report_that_fails(self.example("intersection_requirements.json"))
        data = data_of(page)
        data["ways"][0]["cells"][1][1] = 99
        self.write("page.html", re.sub(r'(id="data">).*?(</script>)', lambda found: found[1] + json.dumps(data) + found[2], page, flags=re.S))
        self.open()
        self.assertEqual(self.browser.run("[...document.querySelectorAll('button.visit')].map((button) => button.disabled)"),
                         [False, False, True] + 6 * [False])  # fmt: skip

    # pages with all of it

    def test_names_of_users_are_no_markup(self):
        evil = "</script><b>bold</b><script>window.taken = 1</script> & {{data}}"
        self.report_that_fails(spec_with(
            states=[dict(state, unit=evil) for state in SPEC["states"]],
            requirements=[{"name": evil, "where": "x <= 4.1 and y <= 4.1 and x >= -0.1 and y >= -0.1", "min_delay": 1}],
            network=TWO_MODES, coordination={"horizon": 1}))  # fmt: skip
        self.open()
        self.focus("button.visit")
        self.visit("Enter")
        self.assertIn(f"“{evil}”", self.browser.run("document.getElementById('way').innerText"))
        self.assertIn(evil, self.browser.run("document.querySelector('#requirements-title').parentElement.innerText"))
        self.assertEqual(self.browser.run("[window.taken ?? 0, document.scripts.length, document.querySelectorAll('b').length]"), [0, 2, 0])
        self.assert_is_quiet()

    def test_keyboard_light_dark_and_narrow(self):
        spec = self.example("intersection_requirements.json")
        spec["network"] = {"delay": 2}
        self.report_that_fails(spec)
        for scheme in ("light", "dark"):
            self.open(width=400, scheme=scheme)
            self.show("modes")
            self.assertTrue(self.browser.run("document.documentElement.scrollWidth === document.documentElement.clientWidth"))
            ground, text = self.browser.run(
                "['backgroundColor', 'color'].map((name) => getComputedStyle(document.body)[name].match(/\\d+/g).map(Number))")
            self.assertEqual(sum(ground) > sum(text), scheme == "light")
            self.assert_is_quiet()
        self.browser.run("document.querySelector('details').open = true; document.activeElement.blur()")
        reached = []
        for _ in range(40):
            self.browser.press("Tab")
            reached.append(self.browser.run("(({className, id, name, tagName}) => className || id || name || tagName)(document.activeElement)"))
        for name, count in (("visit", 9), ("kind", 1), ("member", 1), ("slider-1", 1)):
            self.assertGreaterEqual(reached.count(name), count, reached)
        for node in self.browser.call("Accessibility.getFullAXTree")["nodes"]:
            properties = {entry["name"]: entry["value"].get("value") for entry in node.get("properties", [])}
            if properties.get("focusable") and node["role"]["value"] != "RootWebArea":
                self.assertTrue(node["name"]["value"], node)


if __name__ == "__main__":
    unittest.main()
