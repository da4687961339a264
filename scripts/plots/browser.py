"""What pictures of the page need: a server with whatever touches it, and a Chromium without a window."""
import asyncio
import base64
import json
import re
import subprocess
import tempfile
import threading
import urllib.request
from pathlib import Path

import websockets

CHROMIUM = "chromium"
PATIENCE_S = 60
OPTIONS = ["--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--hide-scrollbars", "--disable-background-networking", "--disable-component-update", "--disable-sync",
           "--no-first-run", "--remote-debugging-port=0"]


class Program:
    """A program that runs until the end of the block, and the first line of it that fits a pattern."""

    def __init__(self, command, ready=None):
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True)
        self.found = None
        for line in self.process.stdout if ready else ():
            self.found = re.search(ready, line)
            if self.found:
                break
        if ready and not self.found:
            raise SystemExit(f"{command[0]} does not become ready")
        # What it prints must go somewhere, or it stops when the pipe is full.
        threading.Thread(target=self.process.stdout.read, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(PATIENCE_S)


class Browser:
    """Talks to Chromium by its DevTools protocol. `scale`: pixels of a picture for one of the page."""

    def __init__(self, width, height, scale):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.size = {"width": width, "height": height, "deviceScaleFactor": scale, "mobile": False}
        self.calls = 0

    async def __aenter__(self):
        self.program = Program([CHROMIUM, *OPTIONS, f"--user-data-dir={self.profile.name}", "about:blank"],
                               r"DevTools listening on ws://([\d.:]+)/")
        with urllib.request.urlopen(f"http://{self.program.found.group(1)}/json", timeout=PATIENCE_S) as answer:
            page = next(target for target in json.load(answer) if target["type"] == "page")
        self.socket = await websockets.connect(page["webSocketDebuggerUrl"], max_size=None, max_queue=None)
        await self.call("Emulation.setDeviceMetricsOverride", **self.size)
        return self

    async def __aexit__(self, *why):
        await self.socket.close()
        self.program.__exit__(*why)
        self.profile.cleanup()

    async def send(self, method, **parameters):
        self.calls += 1
        await self.socket.send(json.dumps({"id": self.calls, "method": method, "params": parameters}))

    async def call(self, method, **parameters):
        await self.send(method, **parameters)
        while True:
            answer = json.loads(await asyncio.wait_for(self.socket.recv(), PATIENCE_S))
            if answer.get("id") == self.calls:
                return answer.get("result", {})

    async def open(self, url, ready):
        """The page at `url`, when the JavaScript expression `ready` holds."""
        await self.call("Page.navigate", url=url)
        await self.wait_for(ready)

    async def value_of(self, expression):
        return (await self.call("Runtime.evaluate", expression=expression))["result"].get("value")

    async def wait_for(self, condition):
        for _ in range(20 * PATIENCE_S):
            if await self.value_of(f"Boolean({condition})"):
                return
            await asyncio.sleep(0.05)
        raise SystemExit(f"the page does not come to: {condition}")

    async def picture(self):
        """The bytes of a PNG."""
        return base64.b64decode((await self.call("Page.captureScreenshot", format="png"))["data"])

    async def frames(self, seconds):
        """What the page shows from now on, as fast as the machine draws it: pairs of the time, s, and a JPEG."""
        await self.call("Page.startScreencast", format="jpeg", quality=95)
        first_s, shown_s = None, 0.0
        while shown_s < seconds:
            event = json.loads(await asyncio.wait_for(self.socket.recv(), PATIENCE_S))
            if event.get("method") != "Page.screencastFrame":
                continue
            frame = event["params"]
            time_s = frame["metadata"]["timestamp"]
            first_s = time_s if first_s is None else first_s
            shown_s = time_s - first_s
            await self.send("Page.screencastFrameAck", sessionId=frame["sessionId"])
            yield shown_s, base64.b64decode(frame["data"])
        await self.call("Page.stopScreencast")


def server(hld, page_folder=None):
    """hld with its stroking hand; its address is found.group(1)."""
    folder = ["--page-dir", page_folder] if page_folder else []
    return Program([hld, "--port", "0", "--explore", "on", *folder], r"event=ready address=http://(\S+?)/")


def built(programs, name):
    """The path of a program beside `programs`, build/bin."""
    path = Path(programs, name)
    if not path.is_file():
        raise SystemExit(f"figures: {path} is not there: run scripts/build first")
    return path
