"""Drives the real browser under a virtual display with synthetic keys and mouse.

The title of the window tells scene, step and pause, so that what a gesture did can be read without looking at pixels;
pictures are compared only to see that something changed. Usage: browse_test.py PROGRAM
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
PATIENCE = 90  # s, until a change must have been seen; the machine may be busy


# Where the check boxes of the overlays are in a window of 1280 x 800 px: groups of two columns under a heading each.
OVERLAY_GROUPS = (6, 6, 3, 3, 5, 4, 4)
OVERLAY_TAB_TOP, GROUP_HEIGHT, ROW_HEIGHT = 52, 24, 25
CHECK_BOXES = (969, 1120)


class Display:
    """An X server of our own, on a number that it chooses."""

    def __init__(self):
        read, write = os.pipe()
        # Without -noreset the server starts over when its last client leaves.
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-noreset"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


class BrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.display = Display()

    @classmethod
    def tearDownClass(cls):
        cls.display.close()

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrine_browse_"))
        self.env = dict(os.environ, DISPLAY=self.display.name, XDG_CONFIG_HOME=str(self.folder))
        self.start("2_stable/tower")

    def tearDown(self):
        # The display outlives a test that failed with a key or a button held down.
        self.xdo("keyup", "ctrl", "mouseup", "1")
        if self.browser.poll() is None:
            self.browser.kill()
        self.browser.wait()
        shutil.rmtree(self.folder)

    def start(self, *target):
        self.browser = subprocess.Popen([PROGRAM, "browse", *target, "--pictures", str(self.folder)], env=self.env)
        self.wait(lambda: "Vitrine" in self.title() and "step" in self.title())
        self.xdo("search", "--name", "Vitrine", "windowfocus")

    def xdo(self, *arguments):
        return subprocess.run(["xdotool", *arguments], env=self.env, capture_output=True, text=True).stdout.strip()

    def key(self, name):
        # The browser keeps what it is sent in order, so that nothing has to wait for a frame.
        self.xdo("key", name)

    def title(self):
        return self.xdo("search", "--name", "Vitrine", "getwindowname").split("\n")[-1]

    def step(self):
        found = re.search(r"step (\d+)", self.title())
        return int(found.group(1)) if found else -1

    def wait(self, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if condition():
                return
            self.assertIsNone(self.browser.poll() if hasattr(self, "browser") else None, "the browser ended")
            time.sleep(0.05)
        self.fail("nothing happened; the title is " + self.title())

    def picture(self):
        """The screen without the time-dependent lower edge."""
        return subprocess.run(["import", "-window", "root", "-crop", "700x700+230+10", "rgb:-"], env=self.env,
                              capture_output=True, check=True).stdout

    def still_picture(self):
        """The picture once nothing has moved in it for four seconds, longer than a message stays."""
        last, still = self.picture(), 0
        for _ in range(60):
            time.sleep(0.5)
            now = self.picture()
            still = still + 1 if now == last else 0
            if still == 8:
                return now
            last = now
        self.fail("the picture of a paused scene goes on changing")

    def pause(self):
        self.key("space")
        self.wait(lambda: "paused" in self.title())
        time.sleep(0.5)

    def test_pause_step_and_step_back(self):
        self.pause()
        at = self.step()
        self.key("period")
        self.wait(lambda: self.step() == at + 1)
        self.key("comma")
        self.key("comma")
        self.wait(lambda: self.step() == at - 1)
        self.key("space")
        self.wait(lambda: self.step() > at + 1)

    def test_restart_and_scene_switching(self):
        self.wait(lambda: self.step() > 20)
        self.pause()
        self.key("r")
        self.wait(lambda: self.step() < 20)
        self.key("bracketright")
        self.wait(lambda: "2_stable/tower" not in self.title())
        self.key("bracketleft")
        self.wait(lambda: "2_stable/tower" in self.title())

    def test_search_finds_a_scene_by_name(self):
        self.open_scene("primit")
        self.assertIn("primitives", self.title())

    def test_overlays_selection_and_help_change_the_picture(self):
        self.xdo("mousemove", "640", "480")  # else it lies where the last test left it, perhaps on something with a hint
        self.pause()
        plain = self.still_picture()
        for key in ("shift+c", "shift+a", "shift+x"):
            self.key(key)
            self.wait(lambda: self.picture() != plain)
            self.key(key)
            self.wait(lambda: self.picture() == plain)
        self.click(640, 480)
        self.wait(lambda: self.picture() != plain)
        self.key("Escape")
        self.wait(lambda: self.picture() == plain)
        self.key("F1")
        self.wait(lambda: self.picture() != plain)

    def test_dragging_turns_the_view_and_home_brings_it_back(self):
        self.xdo("mousemove", "700", "420")
        self.pause()
        plain = self.still_picture()
        self.xdo("mousemove", "600", "400", "mousedown", "1", "sleep", "0.5", "mousemove", "700", "420", "sleep", "0.5",
                 "mouseup", "1")
        self.wait(lambda: self.picture() != plain)
        self.key("Home")
        self.wait(lambda: self.picture() == plain)

    def click(self, x, y):
        self.xdo("mousemove", str(x), str(y), "sleep", "0.3", "mousedown", "1", "sleep", "0.2", "mouseup", "1")

    def click_at_once(self, x, y):
        self.xdo("mousemove", str(x), str(y), "mousedown", "1", "mouseup", "1")

    def open_scene(self, name):
        self.key("ctrl+o")
        self.xdo("type", "--delay", "40", name)
        self.key("Return")
        self.wait(lambda: name in self.title())

    def selection(self):
        """What the title says is selected, or nothing."""
        parts = self.title().split(" - ")
        known = ("paused", "recording", "replay", "Vitrine")
        return [p for p in parts[1:] if not p.startswith(("step", "diverged")) and p not in known]

    def test_a_click_selects_a_body_and_names_it(self):
        self.pause()
        self.assertEqual(self.selection(), [])
        self.click(640, 480)
        self.wait(lambda: self.selection() and re.match(r"(brick|ground)", self.selection()[0]))
        self.key("Escape")
        self.wait(lambda: not self.selection())

    def test_a_click_on_a_large_mesh_names_the_triangle(self):
        self.open_scene("2_stable/landscape")
        self.wait(lambda: self.step() > 5)
        self.pause()
        self.click(420, 640)
        self.wait(lambda: self.selection() and re.match(r"triangle \d+ of landscape", self.selection()[0]))
        first = self.selection()[0]
        self.click(820, 620)
        self.wait(lambda: self.selection() and self.selection()[0] != first)

    def quit_and_read_settings(self):
        self.still_picture()  # clicks come one a frame, keys all at once: those before have been seen
        self.key("ctrl+q")
        self.assertEqual(self.browser.wait(PATIENCE), 0)
        return json.loads((self.folder / "vitrine" / "browse.json").read_text())

    def overlay_boxes(self):
        """Where the check boxes of the tab are that shows them all."""
        y = OVERLAY_TAB_TOP
        for count in OVERLAY_GROUPS:
            y += GROUP_HEIGHT
            for i in range(count):
                yield CHECK_BOXES[i % 2], y
                y += ROW_HEIGHT if i % 2 == 1 or i + 1 == count else 0

    def picture_after_a_change(self, last):
        """The picture when it differs from the last one, or when it has not for longer than a frame takes."""
        for _ in range(5):
            time.sleep(0.1)
            now = self.picture()
            if now != last:
                break
        return now

    def click_and_count_changes(self):
        """Clicks all check boxes; returns how often the picture changed."""
        last, changes = self.still_picture(), 0
        for x, y in self.overlay_boxes():
            self.click_at_once(x, y)
            self.xdo("mousemove", "1100", "790")
            now = self.picture_after_a_change(last)
            changes += now != last
            last = now
        return changes

    def test_every_overlay_can_be_shown_and_taken_back(self):
        unknown = subprocess.run([PROGRAM, "render", "2_stable/landscape", "--overlay", "nonsense", "--out", str(self.folder)],
                                 capture_output=True, text=True).stderr
        names = set(unknown.strip().split("known: ")[-1].split(", "))
        self.assertEqual(len(names), sum(OVERLAY_GROUPS), unknown)
        self.open_scene("2_stable/landscape")
        self.wait(lambda: self.step() > 200)
        self.pause()
        self.click(1160, 26)
        # What does not move has no velocity, and this scene has neither joints nor particles.
        self.assertGreater(self.click_and_count_changes(), 15)
        self.assertEqual(set(self.quit_and_read_settings()["overlays"].split(",")), names)
        self.start("2_stable/landscape")
        self.pause()
        self.click(1160, 26)
        time.sleep(1)
        for x, y in self.overlay_boxes():
            self.click_at_once(x, y)
        self.assertEqual(self.quit_and_read_settings()["overlays"], "none")

    def test_stepping_back_over_a_throw_takes_it_back(self):
        self.pause()
        at = self.step()
        self.xdo("mousemove", "640", "420", "sleep", "0.5")
        self.key("b")
        self.wait(lambda: self.step() > at + 3)
        self.pause()
        for _ in range(200):
            if self.step() <= at:
                break
            self.key("shift+comma")
        self.wait(lambda: self.step() <= at)
        self.key("space")
        self.wait(lambda: self.step() > at + 3)

    def test_a_recording_is_written_and_repeated(self):
        self.key("ctrl+r")
        self.wait(lambda: "recording" in self.title())
        at = self.step()
        self.wait(lambda: self.step() > at + 20)
        self.pause()
        self.key("ctrl+r")
        self.wait(lambda: list(self.folder.glob("2_stable_tower_*.rec")))
        file = next(self.folder.glob("2_stable_tower_*.rec"))
        self.key("ctrl+q")
        self.browser.wait(PATIENCE)
        check = subprocess.run([PROGRAM, "replay", str(file)], env=self.env, capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stderr)
        self.start(str(file))
        self.wait(lambda: "replay" in self.title())
        first = self.step()
        self.key("period")
        self.wait(lambda: self.step() == first + 1)
        self.key("space")
        self.wait(lambda: self.step() > first + 15)
        self.assertNotIn("diverged", self.title())

    def test_a_hundred_scene_switches_leave_nothing_behind(self):
        def memory():
            status = pathlib.Path(f"/proc/{self.browser.pid}/status").read_text()
            return int(re.search(r"VmRSS:\s+(\d+)", status).group(1))

        def switch(times):
            for _ in range(times):
                before = self.title().split(" - ")[0]
                self.xdo("key", "bracketright")
                self.wait(lambda: self.title().split(" - ")[0] != before)

        switch(50)
        settled = memory()
        switch(50)
        self.assertIsNone(self.browser.poll(), "the browser ended: errors of GL end it")
        # What scenes and drivers keep has been kept after the first round of all scenes.
        self.assertLess(memory() - settled, 60000, "kB more after fifty switches")
        self.key("ctrl+q")
        self.assertEqual(self.browser.wait(PATIENCE), 0)

    def test_a_body_can_be_pulled_with_the_mouse(self):
        self.pause()
        before = self.still_picture()
        self.xdo("mousemove", "640", "480", "keydown", "ctrl", "sleep", "0.3", "mousedown", "1", "sleep", "0.3",
                 "mousemove", "560", "250")
        self.wait(lambda: "paused" not in self.title())
        at = self.step()
        self.wait(lambda: self.step() > at + 30)
        self.xdo("mouseup", "1")
        self.xdo("keyup", "ctrl")
        self.assertNotEqual(self.picture(), before)

    def test_a_screenshot_is_saved_and_resizing_keeps_it_alive(self):
        self.key("F12")
        self.wait(lambda: list(self.folder.glob("2_stable_tower_*.png")))
        window = self.xdo("search", "--name", "Vitrine").split("\n")[-1]
        for size in (("500", "400"), ("1280", "800")):
            self.xdo("windowsize", window, *size)
            at = self.step()
            self.wait(lambda: self.step() > at)

    def test_quitting_remembers_the_scene(self):
        self.key("bracketright")
        self.wait(lambda: "2_stable/tower" not in self.title())
        scene = self.title().split(" - ")[0]
        self.key("ctrl+q")
        self.assertEqual(self.browser.wait(PATIENCE), 0)
        self.start()
        self.assertTrue(self.title().startswith(scene))


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    # What fails has waited for long: the rest would do the same.
    unittest.main(failfast=True)
