"""Programmes that send a command Ctrl-C."""

# As soon as there is a page in the folder that is named first; then come the command's arguments.
AT_FIRST_PAGE = """
import os, pathlib, signal, sys, threading, time
from pyopacity.cli import main

def interrupt():
    while not pathlib.Path(sys.argv[1], "index.html").exists():
        time.sleep(0.001)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
sys.exit(main(sys.argv[2:]))
"""
