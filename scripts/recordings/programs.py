"""Programs run for what they write; what they say is shown only if they fail."""
import subprocess


def run_quietly(*command):
    """What the program printed."""
    words = [str(word) for word in command]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}: {done.stdout}{done.stderr}")
    return done.stdout
