"""What rwlog exports is read by readers that know nothing of it."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PROGRAMS = pathlib.Path(os.environ.get("ROOMWISE_PROGRAMS", ROOT / "build/release/bin"))
SAMPLE = ROOT / "logs/samples/living_room.lcmlog"
POINT = struct.Struct("<fff")


class Exports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def rwlog(self, *words):
        return subprocess.run([PROGRAMS / "rwlog", *words], check=True, capture_output=True,
                              text=True).stdout

    def export(self, name, *options):
        out = self.folder / f"made.{name}"
        self.rwlog("export", name, SAMPLE, "-o", out, *options)
        return out

    def read_ply(self, path):
        head, body = path.read_bytes().split(b"end_header\n", 1)
        lines = head.decode().split("\n")
        self.assertEqual(lines[:2], ["ply", "format binary_little_endian 1.0"])
        self.assertEqual([line.split()[1:] for line in lines if line.startswith("property")],
                         [["float", c] for c in "xyz"]
                         + [["uchar", c] for c in ("red", "green", "blue")])
        count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
        self.assertEqual(len(body), 15 * count)
        return [(POINT.unpack_from(body, 15 * i), tuple(body[15 * i + 12:15 * i + 15]))
                for i in range(count)]

    def read_pcd(self, path):
        head, body = path.read_bytes().split(b"DATA binary\n", 1)
        fields = dict(line.split(" ", 1) for line in head.decode().splitlines()[1:])
        self.assertEqual((fields["VERSION"], fields["FIELDS"], fields["SIZE"], fields["TYPE"]),
                         ("0.7", "x y z rgb", "4 4 4 4", "F F F F"))
        count = int(fields["POINTS"])
        self.assertEqual((int(fields["WIDTH"]), fields["HEIGHT"], len(body)), (count, "1", 16 * count))
        return [(POINT.unpack_from(body, 16 * i), tuple(body[16 * i + k] for k in (14, 13, 12)))
                for i in range(count)]

    def test_ply_and_pcd_hold_the_same_coloured_points_of_a_frame(self):
        points = self.read_ply(self.export("ply", "--frame", "3"))
        self.assertEqual(points, self.read_pcd(self.export("pcd", "--frame", "3")))
        self.assertGreater(len(points), 10000)
        on_floor = sum(abs(z) < 0.05 for (_, _, z), _ in points)
        self.assertGreater(on_floor, 500)  # in the robot's frame the floor is at z = 0
        self.assertTrue(all(0 <= x <= 6 and -0.1 < z < 4 for (x, _, z), _ in points))
        self.assertGreater(len({color for _, color in points}), 100)

    def test_a_whole_log_is_one_cloud_thinned_to_a_point_a_cube(self):
        points = self.read_ply(self.export("ply", "--poses", "TRUTH", "--voxel", "0.1"))
        cubes = {tuple(int(c // 0.1) for c in place) for place, _ in points}
        self.assertGreater(len(cubes), 0.99 * len(points))  # means on a cube's very edge aside

    def by_pcl(self, program, source, target):
        """What PCL makes of a file of ours; Debian: pcl-tools."""
        if not shutil.which(program):
            self.skipTest(f"no {program}; scripts/setup --peers installs it")
        subprocess.run([program, source, target], check=True, capture_output=True)
        return target.read_bytes()

    def test_pcl_reads_the_pcd(self):
        pcd = self.export("pcd", "--frame", "3")
        made = self.by_pcl("pcl_pcd2ply", pcd, self.folder / "by_pcl.ply")
        self.assertIn(f"element vertex {len(self.read_pcd(pcd))}\n".encode(), made)

    def test_pcl_reads_the_ply(self):
        ply = self.export("ply", "--frame", "3")
        made = self.by_pcl("pcl_ply2pcd", ply, self.folder / "by_pcl.pcd")
        self.assertIn(f"POINTS {len(self.read_ply(ply))}\n".encode(), made)
        self.assertIn(b"rgb", made.split(b"DATA")[0])

    def test_mcap_has_sound_checksums(self):
        data = self.export("mcap").read_bytes()
        magic = b"\x89MCAP0\r\n"
        self.assertTrue(data.startswith(magic) and data.endswith(magic))
        position, opcodes, data_end = len(magic), [], None
        while position < len(data) - len(magic):
            opcode, size = struct.unpack_from("<BQ", data, position)
            opcodes.append(opcode)
            if opcode == 0x0f:
                data_end = position
                self.assertEqual(struct.unpack_from("<I", data, position + 9)[0],
                                 zlib.crc32(data[:position]))
            position += 9 + size
        self.assertEqual((opcodes[0], opcodes[-1]), (0x01, 0x02))
        footer = position - 29
        summary_start, _, crc = struct.unpack_from("<QQI", data, footer + 9)
        self.assertEqual(summary_start, data_end + 13)
        self.assertEqual(crc, zlib.crc32(data[summary_start:position - 4]))

    def test_the_formats_own_library_reads_the_mcap(self):
        reader = HERE / "mcap_reader"
        if not shutil.which("node"):
            self.skipTest("node is not installed")
        if not (reader / "node_modules/@mcap/core").exists():
            self.skipTest("@mcap/core is not installed: run 'npm ci' in tests/rwlog/mcap_reader")
        made = self.export("mcap")
        read = subprocess.run(["node", reader / "read_mcap.mjs", made], check=True,
                              capture_output=True, text=True)
        found = json.loads(read.stdout)
        topics = found["topics"]
        self.assertEqual(found["total"], sum(topic["count"] for topic in topics.values()))
        self.assertGreater(found["atEnd"], 0)
        self.assertGreater(found["chunks"], 1)
        self.assertEqual(topics["/camera/depth"]["schema"], "foxglove.RawImage")
        self.assertEqual(topics["/camera/color"]["schema"], "foxglove.CompressedImage")
        self.assertEqual(topics["/camera/depth"]["count"], 81)
        truth = topics["/TRUTH"]
        self.assertEqual(truth["count"], 162)
        csv = self.rwlog("csv", SAMPLE, "TRUTH").splitlines()
        first = dict(zip(csv[0].split(","), csv[1].split(",")))
        self.assertEqual(float(first["true_x_m"]), truth["first"]["true_x_m"])


if __name__ == "__main__":
    unittest.main()
