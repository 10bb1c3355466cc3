"""The endings that say what a number measures. SI and radians; degrees exist nowhere."""

SUFFIXES = (
    # lengths, times, angles, rates and their squares
    "m", "mm", "m2", "s", "us", "hz", "rad", "rad2", "m_rad", "mps", "mps2", "radps", "radps2",
    # noise and scale per unit of something
    "per_m", "per_s", "per_rad", "per_px", "mm_per_px", "m_per_m", "rad_per_m", "rad_per_rad",
    "m2_per_m", "rad2_per_m", "rad2_per_rad",
    # images
    "px", "px2", "quanta", "levels", "levels2",
    # electricity and heat
    "v", "a", "c", "ah", "w",
    # no dimension
    "ratio", "log", "log2", "quat", "dof", "sigmas", "mahalanobis_sq",
)


def has_unit(name):
    """Whether a name ends in a known unit: range_noise_m does, range_noise does not."""
    return name.endswith(tuple("_" + suffix for suffix in SUFFIXES))
