"""The results chapter of the thesis in its order: what each table and figure showed, and which
experiments answer it.

Numbers are the thesis's own; where it uses one twice (Tables 5.3 and 5.4) so does this.
"""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Part:
    numbers: str
    name: str
    showed: str
    experiments: tuple = ()
    elsewhere: str = ""  # where it is shown, if by no experiment


CHAPTER = (
    Part("Figure 5.1", "The 3D point cloud",
         "One Kinect frame of a room as coloured points, seen from the side; what reflects is "
         "white, without a reading.", ("point_cloud",)),
    Part("Figure 5.2, Table 5.1", "Landmarks and the threshold",
         "A pixel is a landmark where the depth's slope changes by more than a threshold. Of ten "
         "frames, counted by eye: 145, 77 and 37 landmarks at thresholds of 0, 100 and 1000, of "
         "which 62, 70 and 84 % were good. A higher threshold gives fewer and better ones.",
         ("threshold_pictures", "landmark_thresholds")),
    Part("Figures 5.3, 5.4", "Packed pixels, and whole frames",
         "A depth pixel is 13 bits of millimetres and 3 bits of a player's number. Frames that are "
         "not finished in 1/30 s leak into the next, so the work moved to a thread of its own.",
         elsewhere="No figure of merit, so no experiment: tests take the packed pixel apart bit by "
         "bit and check that no frame leaks into the next (scripts/test -L kinect_pub)."),
    Part("Figure 5.5", "Beside MRPT and others: landmarks",
         "Fewer landmarks than MRPT's 3D visual SLAM, thus easier to localise with. By eye.",
         ("landmark_*",)),
    Part("Figures 5.6, 5.7", "From landmarks to a 2D map",
         "Landmarks of a single frame drawn from above, with some bad points: a mirror gives "
         "depths that are too small, and its place stays empty.", ("map_2d",)),
    Part("Figure 5.8", "People and reflective surfaces removed",
         "One depth picture in which a person and two reflecting windows have been found and "
         "removed.", ("people_and_mirrors",)),
    Part("Figure 5.9", "Average distance",
         "The mean of all depths says how far the robot is from what it faces; 200 mm is safe. "
         "The floor at the bottom of the picture counts as if it were in the way, and what "
         "reflects spoils the mean.", ("average_distance",)),
    Part("Tables 5.2 to 5.9, Figures 5.10 to 5.12", "Segmentation by grey Gaussians",
         "Three classes (obstacle, wall, accessible) taught from pictures, a grey Gaussian each. "
         "Histograms of the training sets; the rate of pixels that differ from a picture "
         "segmented by hand; mean and sigma by average and by iterated threshold (11.1 and 22.6 "
         "against 15.2 and 22.9 for the first set); and in the dark nothing is found any more.",
         ("segment_models",)),
    Part("Figures 5.13, 5.14", "Gaussians and depth together",
         "With depth beside the Gaussian the picture is clearer, but the floor near the camera is "
         "always black: taken for an obstacle.", ("segment_pictures",)),
    Part("Figure 5.15", "Histogram of depths",
         "Depths of one picture from 0 to 4500 mm; its peaks are the things in view.",
         ("depth_histogram",)),
    Part("Figures 5.16 to 5.20", "EKF-SLAM against dead reckoning, one and two rounds",
         "With the decompiled program of somebody else, its simulated robot and known landmarks: "
         "the map of EKF-SLAM is better than that of odometry alone, its error is smaller, and "
         "the distance to the true path grows with the way driven.", ("slam_rounds",)),
    Part("Future work", "Detector and filter together, live",
         "\"I try to combine the landmark detection and the simple slam, and make a real time slam "
         "(I have not finished this part)\"", ("slam_live",)),
    Part("Beyond: real robots", "The filter on recorded drives, beside MRPT",
         "Not in the thesis, which had no robot of its own mapping: two robots of the UTIAS MRCLAM "
         "recordings.", ("slam_mrclam", "slam_causal")),
)
REST = Part("Beyond: how sure, how fast, how robust", "What else was measured",
            "Not in the thesis.", ("*",))


def _takes(pattern, name):
    return name == pattern or (pattern.endswith("*") and name.startswith(pattern[:-1]))


def parts_with(names):
    """[(part, the names of experiments that answer it)]; every name stands once."""
    named = {name for part in CHAPTER for name in part.experiments}
    free = [name for name in names if name not in named]
    found = []
    for part in (*CHAPTER, REST):
        mine = []
        for pattern in part.experiments:
            if pattern.endswith("*"):
                taken = [name for name in free if _takes(pattern, name)]
                free = [name for name in free if name not in taken]
                mine += taken
            elif pattern in names:
                mine.append(pattern)
        found.append((part, mine))
    return found
