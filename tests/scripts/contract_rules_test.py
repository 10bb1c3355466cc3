"""Rules on messages, channels and parameters: each sees a violation, and a clean tree."""
import unittest

from rule_case import RuleCase

from checks import channel_table, message_shapes, message_units, parameters


def message(name, *members, comment=""):
    lines = "".join(f"    {member};\n" for member in members)
    return {f"lcmtypes/{name}.lcm": f"package roomwise;\n{comment}\nstruct {name}\n{{\n{lines}}}\n"}


class MessageUnits(RuleCase):
    rule = message_units

    def test_names_with_units_are_clean(self):
        self.assert_clean(message(
            "a_t", "int64_t utime", "int64_t frame_utime", "double range_m", "float turn_radps",
            "double covariance_x_heading_m_rad", "double score_ratio", "int32_t count",
            "double free_range_m[count]", "string text"))

    def test_a_real_number_without_unit_is_refused(self):
        self.assert_refused(message("a_t", "int64_t utime", "double range", "float pan_deg[3]"),
                            "lcmtypes/a_t.lcm:6: range does not end", "lcmtypes/a_t.lcm:7: pan_deg")

    def test_a_time_that_is_no_int64_is_refused(self):
        self.assert_refused(message("a_t", "int32_t utime"), "lcmtypes/a_t.lcm:5: utime must be")


class MessageShapes(RuleCase):
    rule = message_shapes

    def test_types_that_differ_in_a_name_type_or_dimension_are_clean(self):
        self.assert_clean({**message("a_t", "int64_t x"), **message("b_t", "int32_t x"),
                           **message("c_t", "int64_t y"), **message("d_t", "int64_t x[2]"),
                           **message("e_t", "int64_t x[3]")})

    def test_two_types_of_one_shape_are_refused(self):
        self.assert_refused({**message("a_t", "int64_t x", "double y_m"),
                             **message("b_t", "int64_t x", "double y_m")},
                            "lcmtypes/b_t.lcm:1: has the same members as a_t.lcm")

    def test_members_of_other_name_but_one_shape_are_seen_through(self):
        self.assert_refused({**message("a_t", "int64_t x"), **message("b_t", "int64_t x"),
                             **message("c_t", "a_t part"), **message("d_t", "b_t part")},
                            "b_t.lcm:1: has the same members as a_t", "d_t.lcm:1: has the same")


PARAMS = """
/// Tuning.
struct FilterParams {
  double range_noise_m = 0.05;  ///< double gate, not a member
  int rows_min{4};
  bool greedy = false;
  std::string method = "thesis";

  template <class Field>
  void visit_fields(Field&& field) {
    field("range_noise_m", range_noise_m, 1e-3, 1.0);
    field("rows_min", rows_min, 1, 480);
    field("greedy", greedy);
    field("method", method, {"thesis", "disparity"});
  }
};
struct Estimate {
  double anything = 0;  // not a parameter
};
"""


class Parameters(RuleCase):
    rule = parameters
    path = "services/a_svc/core/filter_params.h"

    def test_units_and_names_that_agree_are_clean(self):
        self.assert_clean({self.path: PARAMS})

    def test_a_parameter_without_unit_is_refused(self):
        self.assert_refused({self.path: PARAMS.replace("range_noise_m", "range_noise")},
                            f"{self.path}:4: range_noise does not end in a known unit")

    def test_two_names_for_one_parameter_are_refused(self):
        self.assert_refused({self.path: PARAMS.replace('"rows_min"', '"rows"')},
                            f'{self.path}:12: field "rows" must be named as its member rows_min')

    GROUP = """
struct JumpParams {
  double range_min_m = 1.22;
  int run_px = 3;
};
struct EdgeParams {
  JumpParams jump;
  template <class Field>
  void visit_fields(Field&& field) {
    field("thesis_range_min_m", jump.range_min_m, 0.0, 4.0);
    field("run_px", jump.run_px, 1, 9);
  }
};
"""

    def test_a_group_may_have_a_word_before_its_names(self):
        self.assert_clean({self.path: self.GROUP})

    def test_a_group_may_name_its_own_members_and_forget_none(self):
        group = """
struct JumpParams {
  double range_min_m = 1.22;
  int run_px = 3;
  template <class Field>
  void visit_fields(Field&& field) {
    field("range_min_m", range_min_m, 0.0, 4.0);
    field("run_px", run_px, 1, 9);
  }
};
struct EdgeParams {
  JumpParams jump;
  template <class Field>
  void visit_fields(Field&& field) {
    jump.visit_fields(field);
  }
};
"""
        self.assert_clean({self.path: group})
        self.assert_refused({self.path: group.replace("    jump.visit_fields(field);\n", "")},
                            f"{self.path}:3: jump.range_min_m is not in visit_fields of EdgeParams",
                            f"{self.path}:4: jump.run_px is not in visit_fields of EdgeParams")

    def test_a_group_that_changes_names_is_refused(self):
        self.assert_refused({self.path: self.GROUP.replace('"run_px"', '"run"')},
                            f'{self.path}:11: field "run" must be named as its member run_px')

    def test_a_group_is_searched_for_units_and_for_what_is_forgotten(self):
        group = self.GROUP.replace("range_min_m", "range_min").replace(
            '    field("run_px", jump.run_px, 1, 9);\n', "")
        self.assert_refused({self.path: group}, f"{self.path}:3: range_min does not end",
                            f"{self.path}:4: jump.run_px is not in visit_fields of EdgeParams")

    def test_a_parameter_nobody_can_set_is_refused(self):
        self.assert_refused({self.path: PARAMS.replace('    field("greedy", greedy);\n', "")},
                            f"{self.path}:6: greedy is not in visit_fields of FilterParams")


CHANNELS = """
inline constexpr Channel<pose_t> kPose{"POSE", ">= 30", "ekf_svc", "all"};
inline constexpr Channel<truth_t> kTruth{"TRUTH", "60", "simulator", "viewer, ekf_svc"};
inline constexpr auto kAllChannels = std::make_tuple(channels::kPose, channels::kTruth);
"""
EMPTY = ("# A\n<!-- channel-table:begin (made) -->\n<!-- channel-table:end -->\n"
         "between\n<!-- channel-diagram:begin -->\n<!-- channel-diagram:end -->\nend\n")


class ChannelTable(RuleCase):
    rule = channel_table

    def files(self, channels=CHANNELS, readme=None):
        files = {"common/channels.h": channels, "README.md": EMPTY, "services/ekf_svc/main.cpp": "",
                 **message("pose_t", "int64_t utime", comment="// Where it is,\n// and\n// how well. Channel POSE.")}
        files["README.md"] = readme or channel_table.fix(self.tree(files))
        return files

    def test_the_table_it_makes_is_clean(self):
        self.assert_clean(self.files())

    def test_it_writes_rows_links_and_dashes_what_does_not_exist(self):
        readme = self.files()["README.md"]
        self.assertIn("| POSE | [pose_t](lcmtypes/pose_t.lcm) | >= 30 | ekf_svc | all "
                      "| Where it is, and how well. |", readme)
        self.assertIn("simulator --> TRUTH([TRUTH]) --> viewer & ekf_svc", readme)
        self.assertIn("class simulator,viewer planned", readme)
        self.assertTrue(readme.startswith("# A\n") and readme.endswith("\nend\n"))
        self.assertIn("\nbetween\n", readme)

    def test_a_table_that_lags_behind_is_refused(self):
        old = self.files()["README.md"]
        self.assert_refused(self.files(CHANNELS.replace('"60"', '"30"'), old),
                            "README.md:2: channel-table differ from common/channels.h")

    def test_a_readme_without_markers_is_refused(self):
        self.assert_refused(self.files(readme="# A\n"), "no <!-- channel-table:begin -->",
                            "no <!-- channel-diagram:begin -->")

    def test_a_channel_tools_do_not_see_is_refused(self):
        self.assert_refused(self.files(CHANNELS.replace(", channels::kTruth", "")),
                            "common/channels.h:3: kTruth is not in kAllChannels")

    def test_a_row_it_cannot_read_is_refused(self):
        self.assert_refused(self.files(CHANNELS + "inline constexpr Channel<x_t> kX{kName, 1};\n"),
                            "common/channels.h:5: cannot read")


if __name__ == "__main__":
    unittest.main()
