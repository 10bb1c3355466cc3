"""The one table of what scripts/start starts. A new service is a row here."""
import dataclasses
import pathlib
from typing import Callable

ROOT = pathlib.Path(__file__).resolve().parents[2]

#: What no replay may put on a bus: who listens would act on it.
COMMANDS = ("VEL_CMD", "VEL_REQUEST", "ESTOP", "SAFETY_RESET", "PILOT_GOAL")


def nothing(_setup):
    return []


@dataclasses.dataclass(frozen=True)
class Service:
    """`arguments` and `environment` make lists of words and NAME=value from a Setup."""
    name: str
    modes: tuple  # of "sim", "robot", "replay": when it belongs to the set
    needs: str    # in words, for who starts it without
    arguments: Callable = nothing
    environment: Callable = nothing


def create_arguments(setup):
    port = ["--port", setup.create_port] if setup.mode == "sim" else []
    return [*port, "--key_path", str(setup.key)] if setup.key else port


def simulator_arguments(setup):
    return ["--scenario", setup.scenario, "--create_port", setup.create_port,
            "--kinect_door", setup.kinect_door]


def kinect_arguments(setup):
    return ["--resolution", setup.camera] if setup.camera else []


def kinect_environment(setup):
    return [f"ROOMWISE_SIM_KINECT={setup.kinect_door}"] if setup.mode == "sim" else []


def safety_arguments(setup):
    return ["--key_path", str(setup.key), "--make_key", "false"] if setup.key else []


def viewer_arguments(_setup):
    return ["--logs_path", str(ROOT / "logs")]


LIVE = ("sim", "robot")
ALWAYS = ("sim", "robot", "replay")

#: In the order in which they start; each bears any other order too.
SERVICES = (
    Service("simulator", ("sim",), "nothing", simulator_arguments),
    Service("create_driver", LIVE, "a Create on its serial port, or simulator", create_arguments),
    Service("kinect_pub", LIVE, "a camera, or simulator", kinect_arguments, kinect_environment),
    Service("landmark_svc", ALWAYS, "KINECT_FRAME of kinect_pub"),
    Service("segment_svc", ALWAYS, "KINECT_FRAME of kinect_pub"),
    Service("ekf_svc", ALWAYS, "ODOMETRY of create_driver, LANDMARKS of landmark_svc"),
    Service("safety_svc", LIVE, "everything above: it stops for what is missing",
            safety_arguments),
    Service("pilot_svc", LIVE, "POSE of ekf_svc, SEGMENTS of segment_svc, safety_svc"),
    Service("viewer", ALWAYS, "nothing: it shows what there is", viewer_arguments),
)


@dataclasses.dataclass(frozen=True)
class Setup:
    """What one run is about."""
    mode: str
    scenario: str
    create_port: str
    kinect_door: str
    programs: pathlib.Path
    camera: str = ""  #: WIDTHxHEIGHT; empty: kinect_pub's own choice
    key: pathlib.Path | None = None  #: that signs commands; None: safety_svc makes one for this machine

    def command(self, service):
        words = [str(self.programs / service.name)]
        params = ROOT / "services" / service.name / "params.toml"
        if params.exists():
            words += ["--params", str(params)]
        return words + service.arguments(self)


def chosen(mode, only, without):
    """The rows that belong to `mode`, less what was left out. Raises ValueError on a foreign name."""
    names = [service.name for service in SERVICES]
    for name in [*only, *without]:
        if name not in names:
            raise ValueError(f"there is no service {name}; there are {', '.join(names)}")
    wanted = [s for s in SERVICES if mode in s.modes and s.name not in without]
    for name in only:
        if mode not in SERVICES[names.index(name)].modes:
            raise ValueError(f"{name} is no part of --{mode}")
    return [s for s in wanted if not only or s.name in only]


def split_by_built(services, programs):
    """(those whose program is there, those whose is not)"""
    built = [s for s in services if (programs / s.name).exists()]
    return built, [s for s in services if s not in built]
