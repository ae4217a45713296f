# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program, one after the other, in the background: progress, and an end that leaves nothing behind."""
import os
import re
import signal
import subprocess
import threading

failed = {1: "failed", 2: "was asked for what it cannot do", 3: "could not read its input", 130: "was stopped"}


class Failed(Exception):
    """With the program's own sentence."""


class Run:
    """Command lines of the program. poll() until it is done; then warnings and outputs."""

    def __init__(self, program, folder, commands):
        self.commands = [[program, *words, "--progress", "0.3"] for words in commands]
        self.count, self.folder = len(self.commands), folder
        self.share, self.what, self.warnings, self.outputs = 0.0, "", [], []
        self.process, self.told, self.said = None, [], []

    def start_next(self):
        words = self.commands.pop(0)
        self.told, self.said = [], []
        self.process = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.readers = [threading.Thread(target=self.listen, daemon=True),
                        threading.Thread(target=lambda: self.said.extend(self.process.stdout), daemon=True)]
        for reader in self.readers:
            reader.start()

    def listen(self):
        for line in self.process.stderr:
            progress = re.match(r"(.*?):\s+(\d+(?:\.\d+)?)\s*%", line)
            if progress:
                self.what, part = progress[1], float(progress[2]) / 100
                self.share = (self.count - len(self.commands) - 1 + part) / self.count
            else:
                self.told.append(line.rstrip())

    def poll(self):
        """Whether all is done. Raises Failed."""
        if not self.process:
            self.start_next()
        if self.process.poll() is None:
            return False
        for reader in self.readers:
            reader.join()
        code, text = self.process.returncode, "\n".join(self.told)
        if code not in (0, 4):  # 4: it is written, and something is wrong with it
            raise Failed(re.sub(r"^error: ", "", text) or "furrow " + failed.get(code, "ended with %d" % code))
        self.warnings += [line for line in self.told if line]
        self.outputs.append("".join(self.said))
        if not self.commands:
            self.share = 1
            return True
        self.start_next()
        return False

    def wait(self):
        while not self.poll():
            try:
                self.process.wait(0.05)
            except subprocess.TimeoutExpired:
                pass

    def stop(self):
        if self.process and self.process.poll() is None:
            self.process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
            try:
                self.process.wait(5)
            except subprocess.TimeoutExpired:
                self.process.kill()
