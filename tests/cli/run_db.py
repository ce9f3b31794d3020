# SPDX-License-Identifier: MIT
# What a run's database holds.
#   run_db.py dump RUN                       every row, but for times and when and how it was run
#   run_db.py rounds RUN                     "seed repeat frames" of each seed and repeat, whole frames
#   run_db.py watch RUN TABLE COMMAND...     starts it and, until it ends, prints what TABLE (a command
#                                            in one word) does, over and over, and its exit status
#   run_db.py SIGNAL RUN FRAMES COMMAND...   starts it and sends it SIGKILL or SIGINT when FRAMES
#                                            frames are stored
import os
import signal
import sqlite3
import subprocess
import sys
import time

OF_THE_TIME = ('seconds_', 'date', 'command_line', 'progress')


def connect(run):
    return sqlite3.connect('file:' + os.path.join(run, 'results.sqlite') + '?mode=ro', uri=True, timeout=10)


def dump(run):
    db = connect(run)
    tables = [row[0] for row in db.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]
    for table in tables:
        columns = [row[1] for row in db.execute(f'PRAGMA table_info({table})')]
        left_out = {'stage_time': 'ms', 'cost': 'value'}.get(table)
        shown = [c for c in columns if c != left_out]
        for row in db.execute(f'SELECT {",".join(shown)} FROM {table} ORDER BY {",".join(shown)}'):
            if table != 'meta' or not row[0].startswith(OF_THE_TIME):
                print(table, *row)


def frames(db):
    return db.execute('SELECT count(*) FROM (SELECT DISTINCT trial, frame, repeat FROM stage_time)').fetchone()[0]


def rounds(run):
    for row in connect(run).execute(
            'SELECT t.seed, s.repeat, count(*) FROM stage_time s JOIN trial t ON t.id = s.trial'
            " WHERE s.stage = 'rsm' GROUP BY t.seed, s.repeat ORDER BY s.repeat, t.seed"):
        print(*row)


def stop(name, run, count, command):
    sent = False
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None:
        try:
            if not sent and frames(connect(run)) >= count:
                process.send_signal(signal.Signals[name])
                sent = True
        except sqlite3.Error:  # not there yet
            pass
        time.sleep(0.002)
    sys.exit(0 if sent and process.returncode != 0 else f'ended with {process.returncode} by itself')


def watch(run, table, command):
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    while process.poll() is None:
        if not os.path.exists(os.path.join(run, 'results.sqlite')):
            time.sleep(0.002)
            continue
        shown = subprocess.run(table, shell=True, capture_output=True, text=True)
        print(shown.stdout + shown.stderr + f'-- {shown.returncode}')
    sys.exit(process.returncode)


if sys.argv[1] == 'watch':
    watch(sys.argv[2], sys.argv[3], sys.argv[4:])
elif sys.argv[1].startswith('SIG'):
    stop(sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:])
else:
    {'dump': dump, 'rounds': rounds}[sys.argv[1]](sys.argv[2])
