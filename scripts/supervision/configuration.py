"""supervisord's configuration for one run."""
import shlex

GROUP = "roomwise"
#: A service that ends within START_s counts as failed to start: tried again after 1, 2, ... s, and
#: after TRIES of that as long as scripts/start keeps asking.
START_s = 1
TRIES = 5
STOP_s = 2

HEAD = """\
[supervisord]
nodaemon = true
pidfile = {pid}
logfile = {log}
logfile_maxbytes = 1MB
logfile_backups = 1
childlogdir = {logs}
loglevel = info

[unix_http_server]
file = {socket}
chmod = 0700

[rpcinterface:supervisor]
supervisor.rpcinterface_factory = supervisor.rpcinterface:make_main_rpcinterface

[group:{group}]
programs = {names}
"""

# A service whose supervisor dies (SIGKILL too) is told to end, rather than left alone.
PROGRAM = """
[program:{name}]
command = setpriv --pdeathsig TERM -- {command}
environment = {environment}
priority = {priority}
autorestart = {autorestart}
startsecs = {start_s}
startretries = {tries}
stopsignal = TERM
stopwaitsecs = {stop_s}
stopasgroup = true
killasgroup = true
redirect_stderr = true
stdout_logfile = {log}
stdout_logfile_maxbytes = 10MB
stdout_logfile_backups = 2
"""


def escaped(text):
    return str(text).replace("%", "%%")


def quoted(setting):
    name, value = setting.split("=", 1)
    return f'{name}="{escaped(value)}"'


def configuration(folder, jobs):
    """The text for `jobs`: rows of (name, words, NAME=value settings, restart or run once)."""
    text = HEAD.format(pid=escaped(folder.supervisor_pid), socket=escaped(folder.socket),
                       log=escaped(folder.log("supervisord")), logs=escaped(folder.logs),
                       group=GROUP, names=",".join(name for name, *_ in jobs))
    for priority, (name, words, settings, restart) in enumerate(jobs, start=1):
        text += PROGRAM.format(
            name=name, command=escaped(shlex.join(words)), priority=priority,
            environment=",".join(map(quoted, settings)), log=escaped(folder.log(name)),
            autorestart="true" if restart else "false", start_s=START_s if restart else 0,
            tries=TRIES, stop_s=STOP_s)
    return text
