"""Rules on C++ sources and on files as such: each sees a violation, and a clean tree."""
import unittest

from rule_case import RuleCase

from checks import (citations, core_purity, file_length, formatting, initial_values, layers, links,
                    machine_traces, names, service_folders, shell_scripts)


class CorePurity(RuleCase):
    rule = core_purity

    def test_mathematics_is_clean(self):
        self.assert_clean({"services/x_svc/core/x.h": """
#include <chrono>
#include <vector>
#include "common/geometry/pose2.h"
#include "services/x_svc/core/y.h"
// Not a clock: std::chrono::system_clock::now(), rand(), printf("x")
inline double mean(const X& x) { return x.time() + x.time(0) + brand(1) + log("::now()"); }
"""})

    def test_what_cores_share_of_the_create_is_held_to_the_same(self):
        source = "#include <thread>\n"
        self.assert_refused({"common/create/oi_decoder.h": source},
                            "common/create/oi_decoder.h:1: core must not include thread")
        self.assert_clean({"services/x_svc/core/x.h": '#include "common/create/oi_decoder.h"\n'})
        self.assert_refused({"services/x_svc/core/x.h": '#include "common/create/create_messages.h"\n'},
                            "services/x_svc/core/x.h:1: core must not include")

    def test_the_world_outside_core_is_allowed(self):
        self.assert_clean({"services/x_svc/x_service.cpp": "#include <mutex>\n#include <iostream>\n"})

    def test_each_forbidden_include_is_refused(self):
        for header in ("<lcm/lcm-cpp.hpp>", "<iostream>", "<fstream>", "<thread>", "<mutex>",
                       '"roomwise/pose_t.hpp"', '"common/bus/bus.h"', "<opencv2/highgui.hpp>",
                       '"services/x_svc/x_service.h"', '"common/params/params.h"'):
            with self.subTest(header):
                self.assert_refused({"services/x_svc/core/x.cpp": f"\n#include {header}\n"},
                                    "services/x_svc/core/x.cpp:2: core must not include")

    def test_each_forbidden_call_is_refused(self):
        for call, deed in (("std::chrono::steady_clock::now()", "reads a clock"),
                           ("std::time(nullptr)", "reads a clock"),
                           ('getenv("HOME")', "reads the environment"),
                           ("std::random_device{}()", "draws its own random numbers"),
                           ("rand()", "draws its own random numbers"),
                           ("std::cout << 1", "does input or output"),
                           ("exit(1)", "leaves the program")):
            with self.subTest(call):
                self.assert_refused({"services/x_svc/core/x.cpp": f"\n\nauto x = {call};\n"},
                                    f"services/x_svc/core/x.cpp:3: core {deed}")

    def test_links_to_mathematics_are_clean(self):
        self.assert_clean({"services/x_svc/CMakeLists.txt": """
roomwise_library(x_core SOURCES core/x.cpp  # and nothing else
                 LINKS common_geometry common_image Eigen3::Eigen opencv_core opencv_imgproc)
roomwise_library(x_service SOURCES x_service.cpp LINKS x_core common_bus)
"""})

    def test_a_core_that_links_the_bus_is_refused(self):
        self.assert_refused({"services/x_svc/CMakeLists.txt":
                             "roomwise_library(x_core SOURCES core/x.cpp LINKS common_bus)\n"},
                            "CMakeLists.txt:1: x_core is a core and must not link common_bus")

    def test_a_core_by_another_name_or_a_later_link_is_refused(self):
        self.assert_refused({"services/x_svc/CMakeLists.txt": """
roomwise_library(mathematics SOURCES core/x.cpp)
target_link_libraries(mathematics PUBLIC opencv_core ${OpenCV_LIBS})
"""}, "CMakeLists.txt:3: mathematics is a core and must not link ${OpenCV_LIBS}")


class Layers(RuleCase):
    rule = layers

    def test_includes_that_point_down_are_clean(self):
        self.assert_clean({
            "services/a_svc/a_service.h": '#include "services/a_svc/core/a.h"\n'
                                          '#include "common/bus/bus.h"\n',
            "common/bus/bus.h": '#include "roomwise/pose_t.hpp"\n',
            "logs/tools/train.cpp": '#include "services/a_svc/core/a.h"\n'
                                    '#include "logs/tools/train.h"\n',
            "tests/a_svc/a_test.cpp": '#include "services/a_svc/a_service.h"\n'})

    def test_a_service_that_includes_another_is_refused(self):
        self.assert_refused({"services/a_svc/a.h": '#include "services/b_svc/core/b.h"\n'},
                            "services/a_svc/a.h:1: services/a_svc must not include")

    def test_common_that_includes_a_service_is_refused(self):
        self.assert_refused({"common/a.h": '#include "services/b_svc/core/b.h"\n'},
                            "common/a.h:1: common must not")

    def test_a_tool_that_includes_a_shell_is_refused(self):
        self.assert_refused({"logs/tools/a.h": '#include "services/b_svc/b_service.h"\n'},
                            "logs/tools/a.h:1: logs must not")

    def test_a_program_that_includes_a_test_is_refused(self):
        self.assert_refused({"services/b_svc/b.h": '#include "tests/support/world.h"\n'},
                            "services/b_svc/b.h:1:")


class Formatting(RuleCase):
    rule = formatting
    style = {".clang-format": "BasedOnStyle: Google\nColumnLimit: 100\n"}

    def test_formatted_code_is_clean(self):
        self.assert_clean({**self.style, "a.h": "#pragma once\nint f(int x);\n"})

    def test_other_layout_is_refused_once_a_file(self):
        self.assert_refused({**self.style, "a.h": "int  f( int x );\nint  g( );\n", "b.cpp": "int x;\n"},
                            "a.h:1: not as clang-format has it")


class ServiceFolders(RuleCase):
    rule = service_folders

    def test_a_service_with_both_is_clean(self):
        self.assert_clean({"services/CMakeLists.txt": "", "services/a_svc/main.cpp": "",
                           "services/a_svc/README.md": "", "services/a_svc/params.toml": ""})

    def test_a_service_without_is_refused(self):
        self.assert_refused({"services/a_svc/main.cpp": ""}, "services/a_svc:1: has no README.md",
                            "services/a_svc:1: has no params.toml")


class Names(RuleCase):
    rule = names

    def test_names_of_ideas_are_clean(self):
        self.assert_clean({"common/geometry/angle.h": "", "services/miscible_svc/futile.h": ""})

    def test_drawers_are_refused(self):
        self.assert_refused({"common/utils.h": "", "common/string-helpers/a.h": "",
                             "services/a_svc/map_manager.cpp": "", "misc/a.h": ""},
                            "common/utils.h:1", "common/string-helpers/a.h:1",
                            "services/a_svc/map_manager.cpp:1", "misc/a.h:1")


class FileLength(RuleCase):
    rule = file_length

    def test_400_lines_are_clean(self):
        self.assert_clean({"a.cpp": "\n" * 400, "data.csv": "\n" * 1000})

    def test_401_lines_are_refused(self):
        self.assert_refused({"a.cpp": "\n" * 401, "scripts/demo": "\n" * 401},
                            "a.cpp:401: 401 lines", "scripts/demo:401:")


class InitialValues(RuleCase):
    rule = initial_values

    def test_values_in_declaration_or_constructor_are_clean(self):
        self.assert_clean({
            "common/a.h": "class A {\n  A();\n  int a_ = 0;\n  double b_{};\n  bool c_;\n  B* d_;\n};\n"
                          "struct S {\n  int a;\n};\n",
            "common/a.cpp": "A::A()\n    : c_(true),\n      d_{nullptr} {}\n"})

    def test_a_number_nobody_sets_is_refused(self):
        self.assert_refused({"common/a.h": "class A {\n  std::size_t size_;\n  const char* name_;\n"
                                           "  void f() { g(size_, 1); }\n};\n"},
                            "common/a.h:2: size_ has no initial", "common/a.h:3: name_ has no initial")


class Links(RuleCase):
    rule = links

    def test_files_folders_and_addresses_are_clean(self):
        self.assert_clean({"a/b.h": "", "README.md": "[b](a/b.h) [b](a/b.h#L3) [a](a/) [x](https://x.org)",
                           "a/README.md": "[up](../README.md) [here](b.h), f[i](x y)"})

    def test_a_link_to_nothing_is_refused(self):
        self.assert_refused({"a/README.md": "see\n[b](b.h)\n"}, "a/README.md:2: b.h is not there")


class MachineTraces(RuleCase):
    rule = machine_traces

    def test_relative_paths_and_public_addresses_are_clean(self):
        self.assert_clean({"README.md": "build/work/ and ../home/x, $TMP/root/y, "
                                        "https://lcm-proj.github.io/home/ "
                                        "udpm://239.255.76.67:7667 https://a.org/the/registry\n"})

    def test_paths_of_one_machine_are_refused(self):
        for folder in ("work", "root", "home"):
            with self.subTest(folder):
                self.assert_refused({"a.md": f"see\n`/{folder}/me/x`\n"}, "a.md:2: a path of one machine")

    def test_mirrors_and_private_hosts_are_refused(self):
        for host in ("registry.corp.example/npm", "artifactory.example.com", "10.1.2.3/x",
                     "build.example.internal/x", "example.com/artifactory/npm"):
            with self.subTest(host):
                found = self.rule.check(self.tree({"a.json": "https" + f"://{host}"}))
                self.assertTrue(found and found[0].startswith("a.json:1:"), found)


class Citations(RuleCase):
    rule = citations

    def test_papers_are_clean(self):
        self.assert_clean({"a.h": "// Thrun, Burgard, Fox (2005), table 10.1. Design 3; facts 4.\n"})

    def test_working_notes_are_refused(self):
        for note in ("ALGORITHMS", "FACTS"):
            with self.subTest(note):
                self.assert_refused({"a.h": f"int x;  // see {note} 4.2\n"}, f"a.h:1: '{note} 4")


class ShellScripts(RuleCase):
    rule = shell_scripts

    def test_strict_scripts_are_clean(self):
        self.assert_clean({"scripts/a": "#!/usr/bin/env bash\nset -euo pipefail\n",
                           "scripts/b": "#!/usr/bin/env python3\n",
                           ".ci/run": "#!/bin/bash\n# why\nset -euo pipefail\n",
                           "scripts/checks/names.py": "x = 1\n"})

    def test_a_script_that_goes_on_after_failures_is_refused(self):
        self.assert_refused({"scripts/a": "#!/bin/bash\nset -e\n"}, "scripts/a:1: no 'set -euo")

    def test_a_script_nobody_can_run_is_refused(self):
        self.assert_refused({"scripts/a": "set -euo pipefail\n"}, "scripts/a:1: no #! line",
                            "scripts/a:1: not executable", executable=False)


if __name__ == "__main__":
    unittest.main()
