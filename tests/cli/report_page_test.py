"""The page of `coordreq report` in a browser."""

import json
import re
import unittest

from browser import Browser
from program import SPEC, spec_with
from report_case import FOUR, PageCase, data_of, packed, unpacked

CIRCLE_COLOURS = {"none: the cell is not safe": [127, 127, 127],
                  "none: on this grid no coordination keeps the system safe from here": [189, 189, 189],
                  "unbounded: safe without coordination indefinitely": [255, 255, 255]}  # fmt: skip


class Cases(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def test_values_under_the_pointer(self):
        self.report(self.example("circle.json"))
        self.open()
        colours = set()
        for place in ((0.001, 0.001), (0.999, 0.999), (0.5, 0.5), (0.3, 0.62), (0.12, 0.5), (0.51, 0.879), (0.7, 0.2)):
            colour = self.point(*place)
            cell = self.cell()
            self.assert_is_answer(cell, "horizontal|vertical")
            index = [int(k) for k in re.search(r"index \((\d+), (\d+)\)", cell["Cell"]).groups()]
            self.assertEqual(index, [int(share * 201) for share in place])
            expected = CIRCLE_COLOURS.get(cell["Delay"])
            self.assertTrue(colour == expected if expected else len(set(colour)) > 1, (cell, colour))
            colours.add(str(colour))
        self.assertGreater(len(colours), 4)
        self.assert_is_quiet()

    def test_a_click_keeps_the_cell(self):
        self.report(SPEC)
        self.open()
        left, top, width, height = self.box("#picture")
        self.browser.click(left + 62 + 5, top + 8 + 5)
        kept = self.cell()
        self.assertEqual(kept["Centre"], "x = 0 m, y = 4 m")
        self.point(0.9, 0.1)
        self.assertEqual(self.cell()["Centre"], "x = 4 m, y = 0 m")
        self.browser.point(1, 1)
        self.assertEqual(self.cell(), kept)

    def test_four_dimensions(self):
        self.report(FOUR)
        self.open()
        names = ["p", "gear", "v", "q"]
        for across, up in (("v", "p"), ("q", "gear"), ("p", "q")):
            self.select("across", names.index(across))
            self.select("up", names.index(up))
            sliders = self.browser.run("[...document.querySelectorAll('#sliders label')].map((label) => label.innerText)")
            self.assertEqual(sliders, [name for name in names if name not in (across, up)])
            self.assertEqual(self.browser.run("document.getElementById('picture').getAttribute('aria-label')"),
                             f"Delay (silence without risk) over {across} and {up}")  # fmt: skip
            self.point(0.6, 0.6)
            self.assert_is_answer(self.cell(), "alone")
        seen = {}
        for across in range(0, 13, 2):
            for up in range(0, 13, 2):
                self.point((across + 0.5) / 13, (up + 0.5) / 13)
                cell = self.cell()
                seen.setdefault(cell["Connect in"], cell)
        for cell in seen.values():
            self.assert_is_answer(cell, "alone")
        self.assertLessEqual({"a connection must exist already", "start to connect now", "none"}, set(seen))
        self.select("partition", 1)
        self.assert_is_answer(self.cell(), "together")
        self.assertIn("(100 %) tolerate this much silence.", self.browser.run("document.getElementById('chart-reading').innerText"))
        self.assert_is_quiet()

    def test_equal_axes_are_swapped(self):
        self.report(FOUR)
        self.open()
        self.select("across", 3)
        self.assertEqual(self.browser.run("[document.getElementById('across').value, document.getElementById('up').value]"), ["3", "0"])

    def test_a_slider_changes_the_picture(self):
        self.report(FOUR)
        self.open()
        self.focus("#sliders input")
        self.browser.press("ArrowLeft")
        self.assertIn("gear = 1", self.cell()["Centre"])
        self.focus("#slider-2")
        self.assert_picture_changes(lambda: self.browser.press("ArrowLeft"))
        self.assertIn("v = 0.5 m/s", self.cell()["Centre"])
        self.assertEqual(self.browser.run("document.getElementById('slider-2').getAttribute('aria-valuetext')"), "0.5 m/s")
        self.assert_is_answer(self.cell(), "alone")

    def test_tables_of_stories_on_wide_and_narrow_screens(self):
        self.report_that_fails(self.example("intersection_requirements.json"))
        self.open()
        self.addCleanup(self.browser.call, "Emulation.clearDeviceMetricsOverride")
        inner = "(() => { const box = document.querySelector('.story').parentElement; return [box.clientWidth, box.scrollWidth]; })()"
        for width in (1700, 390):
            self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
            shown, needed = self.browser.run(inner)
            self.assertEqual(self.browser.run("document.documentElement.scrollWidth"), width)
            if width == 1700:
                self.assertGreater(needed, 720)  # more than a column of text
                self.assertEqual(shown, needed)

    def test_other_maps(self):
        self.report(FOUR)
        self.open()
        self.focus("#kinds input")
        self.assert_picture_changes(lambda: self.browser.press("ArrowRight"))
        legend = self.browser.run("document.getElementById('legend').innerText")
        self.assertEqual(legend, "not safe\nnever leaves the safe set, with coordination")

    def test_keyboard_reaches_everything(self):
        self.report(FOUR)
        self.open()
        reached = []
        for _ in range(20):
            self.browser.press("Tab")
            name = self.browser.run("document.activeElement.id || document.activeElement.name || document.activeElement.tagName")
            if name == "BODY" or name in reached:
                break
            reached.append(name)
        self.assertEqual(reached, ["theme", "kind", "partition", "across", "up", "slider-1", "slider-2", "picture", "best", "chart", "SUMMARY"])
        for node in self.browser.call("Accessibility.getFullAXTree")["nodes"]:
            properties = {entry["name"]: entry["value"].get("value") for entry in node.get("properties", [])}
            if properties.get("focusable") and node["role"]["value"] != "RootWebArea":
                self.assertTrue(node["name"]["value"], node)

    def test_arrow_keys_move_the_cell(self):
        self.report(self.example("circle.json"))
        self.open()
        self.focus("#picture")
        for key, shift, index in (("ArrowRight", False, (100, 100)), ("ArrowUp", True, (100, 110)), ("ArrowLeft", True, (90, 110)),
                                  ("Home", False, (0, 110)), ("ArrowLeft", False, (0, 110)), ("End", False, (200, 110)),
                                  ("ArrowDown", False, (200, 109))):  # fmt: skip
            self.browser.press(key, shift=shift)
            self.assertTrue(self.cell()["Cell"].endswith("index ({}, {})".format(*index)), self.cell())
        self.assert_is_answer(self.cell(), "horizontal|vertical")
        self.assertIn("Delay: none: the cell is not safe", self.browser.run("document.getElementById('spoken').textContent"))

    def test_best_state(self):
        self.report(self.example("circle.json"))
        self.open()
        self.focus("#best")
        self.browser.press("Enter")
        self.assertEqual((self.cell()["Centre"], self.cell()["Delay"]), ("x1 = -0.01 m, x2 = 0 m", "28 steps (0.28 s)"))

    def test_chart(self):
        self.report(self.example("circle.json"))
        self.open()
        self.focus("#chart")
        reading = "document.getElementById('chart-reading').innerText"
        self.browser.press("ArrowRight")
        self.assertEqual(self.browser.run(reading), "0.02 s (2 steps): 17,869 of 20,077 states (89 %) tolerate this much silence.")
        self.browser.press("End")
        self.assertEqual(self.browser.run(reading), "0.29 s (29 steps): 0 of 20,077 states (0 %) tolerate this much silence.")

    def test_light_and_dark(self):
        self.report(SPEC)
        page = "getComputedStyle(document.body).backgroundColor"
        self.open(scheme="light")
        light = self.browser.run(page)
        self.browser.prefer("dark")
        dark = self.browser.run(page)
        self.assertEqual((light, dark), ("rgb(255, 255, 255)", "rgb(21, 24, 28)"))
        self.focus("#theme")
        self.browser.press("Enter")
        self.assertEqual(self.browser.run(page), light)
        self.browser.prefer("light")
        self.browser.press("Enter")
        self.assertEqual(self.browser.run(page), dark)
        self.assert_is_quiet()

    def test_narrow_screens_do_not_scroll_sideways(self):
        self.report(self.example("intersection_coarse.json"))
        self.open(width=400)
        self.assertTrue(self.browser.run("document.documentElement.scrollWidth === document.documentElement.clientWidth"))

    def test_text_of_users_does_nothing(self):
        evil = "</script><script>window.taken = 1</script><img src=x onerror='window.taken = 1'>"
        self.report(spec_with(description=evil, states=[dict(state, unit=evil) for state in SPEC["states"]],
                              dynamics=dict(SPEC["dynamics"], unit=evil)))  # fmt: skip
        self.open()
        self.assertEqual(self.browser.run("[window.taken ?? 0, document.scripts.length, document.images.length]"), [0, 2, 0])
        self.assertIn(evil, self.cell()["Centre"])
        self.assert_is_quiet()

    def test_pages_without_pictures_to_speak_of(self):
        stays = {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}
        strip = {"states": SPEC["states"][:1], "safe": "x <= 3", "dynamics": dict(stays, equations={"x": "x + u*v"})}
        for changes in ({"safe": "false"}, {"safe": "true", "dynamics": stays}, strip, {"coordination": {"max_delay": 0}}):
            with self.subTest(changes=changes):
                self.report(spec_with(**changes))
                self.open()
                self.point(0.5, 0.5)
                self.assert_is_answer(self.cell(), "a|b")
                self.assert_is_quiet()

    def test_fewer_cells_than_the_file(self):
        """A large result has a set of cells for every two dimensions."""
        page = self.report(FOUR)
        data = data_of(page)
        (whole,) = data["sets"]
        shape = [len(indices) for indices in whole["indices"]]
        maps = [unpacked(map).reshape(shape) for map in whole["maps"]]
        data["sets"] = []
        for shows in ((0, 3), (0, 1), (0, 2), (1, 2), (1, 3), (2, 3)):
            indices = [list(range(n)) if i in shows else [1] if n < 4 else [2, 7] for i, n in enumerate(shape)]
            cut = [map[indices[0]][:, indices[1]][:, :, indices[2]][:, :, :, indices[3]] for map in maps]
            data["sets"].append({"shows": shows, "indices": indices, "maps": [packed(values) for values in cut]})
        thinned = json.dumps(data).replace("<", "\\u003c")
        self.write("page.html", re.sub(r'(id="data">).*?(</script>)', lambda found: found[1] + thinned + found[2], page, flags=re.S))
        self.open()
        self.assertIn("of gear, v it has only some values", self.browser.run("document.getElementById('thinned').innerText"))
        self.point(0.6, 0.3)
        self.assert_is_answer(self.cell(), "alone")
        self.select("across", 2)
        self.browser.wait_for("document.getElementById('slider-0') !== null")
        self.assertEqual(self.browser.run("document.getElementById('slider-0').max"), "1")
        for place in ((0.1, 0.1), (0.6, 0.9)):
            self.point(*place)
            self.assert_is_answer(self.cell(), "alone")
        self.focus("#slider-0")
        self.browser.press("End")
        self.assertIn("p = 0.5 m", self.cell()["Centre"])
        self.assert_is_answer(self.cell(), "alone")
        self.assert_is_quiet()


if __name__ == "__main__":
    unittest.main()
