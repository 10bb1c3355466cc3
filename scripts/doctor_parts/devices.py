"""Are the camera and the robot there, and may this user open them?"""
from doctor_parts.finding import fault, fine, nothing

#: Vendors of OpenNI2 cameras; of Microsoft only the Kinect v1's camera.
VENDORS = {"1d27": "PrimeSense", "2bc5": "Orbbec"}
DEVICES = {("045e", "02ae"): "Kinect v1", ("045e", "02bf"): "Kinect for Windows"}
SERIAL = ("/dev/ttyUSB*", "/dev/ttyACM*")


def camera(machine):
    name = "camera"
    for folder in sorted(machine.path("/sys/bus/usb/devices").glob("*")):
        ids = [machine.read(f"/sys/bus/usb/devices/{folder.name}/{file}")
               for file in ("idVendor", "idProduct", "busnum", "devnum")]
        kind = VENDORS.get(ids[0]) or DEVICES.get((ids[0], ids[1]))
        if not kind or None in ids:
            continue
        node = f"/dev/bus/usb/{int(ids[2]):03d}/{int(ids[3]):03d}"
        if machine.may_use(node):
            return fine(name, f"{kind} on {node}")
        rule = (f'SUBSYSTEM=="usb", ATTR{{idVendor}}=="{ids[0]}", ATTR{{idProduct}}=="{ids[1]}", '
                'MODE="0660", TAG+="uaccess", GROUP="plugdev"')
        return fault(name, f"{kind} on {node}, but you may not open it",
                     f"echo '{rule}' | sudo tee /etc/udev/rules.d/60-roomwise-camera.rules && "
                     "sudo udevadm control --reload && sudo udevadm trigger && "
                     "sudo usermod -aG plugdev \"$USER\"  # then log in anew")
    return nothing(name, "none is plugged in (scripts/start --sim needs none)")


def serial(machine):
    name = "serial port"
    ports = [f"/dev/{path.name}" for pattern in SERIAL
             for path in sorted(machine.path("/dev").glob(pattern.removeprefix("/dev/")))]
    if not ports:
        return nothing(name, "none is plugged in (scripts/start --sim needs none)")
    closed = [port for port in ports if not machine.may_use(port)]
    if closed:
        return fault(name, f"you may not open {', '.join(closed)}",
                     "sudo usermod -aG dialout \"$USER\"  # then log in anew")
    return fine(name, ", ".join(ports))
