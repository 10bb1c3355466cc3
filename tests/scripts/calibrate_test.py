"""scripts/calibrate changes the lines of the wheels in a parameter file, and no others."""
import importlib.machinery
import importlib.util
import pathlib
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "calibrate"


def load():
    loader = importlib.machinery.SourceFileLoader("calibrate", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("calibrate", loader))
    loader.exec_module(module)
    return module


class Merged(unittest.TestCase):
    measured = "wheel_base_m = 0.24\nleft_scale_ratio = 0.99\n"

    def test_lines_of_the_same_name_are_replaced_and_others_kept(self):
        params = "# mine\nport = \"/dev/x\"\nwheel_base_m=0.235   # old\nmode = \"safe\"\n"
        self.assertEqual(load().merged(params, self.measured),
                         "# mine\nport = \"/dev/x\"\nwheel_base_m = 0.24\nmode = \"safe\"\n"
                         "left_scale_ratio = 0.99\n")

    def test_a_comment_that_names_a_parameter_stays(self):
        params = "# wheel_base_m = 0.258 for a Create 1"
        self.assertEqual(load().merged(params, self.measured), params + "\n" + self.measured)

    def test_merging_twice_changes_nothing_more(self):
        once = load().merged("", self.measured)
        self.assertEqual(load().merged(once, self.measured), once)


if __name__ == "__main__":
    unittest.main()
