"""A real browser for pages: chromium without a window, driven by its DevTools protocol over pipes."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")
MOST_WAITS = 2000
"""Looks at a page, 30 ms apart, until it counts as not loaded."""


def need_browser() -> str:
    """The program of a browser; a test without one is skipped."""
    for name in NAMES:
        if found := shutil.which(name):
            return found
    pytest.skip("There is no chromium: pages are not tried in a browser.")


class Browser:
    """One tab of a browser.

    Attributes:
        messages: what went wrong: errors and warnings of the console, and exceptions.
        requests: the addresses that pages asked for.
    """

    def __init__(self, send: BinaryIO, receive: BinaryIO) -> None:
        self._send, self._receive = send, receive
        self._serial, self._session = 0, ""
        self.messages: list[str] = []
        self.requests: list[str] = []
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        found = self._ask("Target.attachToTarget", targetId=target, flatten=True)
        self._session = found["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self._ask(f"{domain}.enable")

    def open(self, path: Path, *, width: int = 1200, height: int = 900, part: str = "") -> None:
        """Show a file in a window of that size and wait until it is loaded."""
        self.messages.clear()
        self.requests.clear()
        self.resize(width, height)
        address = path.resolve().as_uri()
        self._ask("Page.navigate", url="about:blank")
        self._ask("Page.navigate", url=address + part)
        there = (
            f"document.readyState === 'complete' && location.href.startsWith({json.dumps(address)})"
        )
        for _ in range(MOST_WAITS):
            if self.evaluate(there):
                break
            time.sleep(0.03)
        else:
            raise AssertionError(f"{address} is not loaded")
        self.settle()

    def settle(self) -> None:
        """Wait until what was asked for is drawn."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => setTimeout(done, 30)))")

    def resize(self, width: int, height: int) -> None:
        """Give the window a size; a narrow one is a phone's."""
        self._ask(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=1, mobile=width < 500,
        )  # fmt: skip

    def dark(self, chosen: bool) -> None:
        """Prefer dark or light colours."""
        value = "dark" if chosen else "light"
        self._ask(
            "Emulation.setEmulatedMedia",
            features=[{"name": "prefers-color-scheme", "value": value}],
        )

    def evaluate(self, script: str) -> Any:
        """The value of an expression of JavaScript."""
        found = self._ask(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True
        )
        if "exceptionDetails" in found:
            raise AssertionError(found["exceptionDetails"])
        return found["result"].get("value")

    def click(self, selector: str) -> None:
        """Click with the mouse in the middle of an element."""
        place = self.middle(selector)
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            count = {"button": "left", "clickCount": 1} if kind != "mouseMoved" else {}
            self._ask("Input.dispatchMouseEvent", type=kind, **place, **count)
        self.settle()

    def move(self, x: float, y: float) -> None:
        """Move the mouse."""
        self._ask("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Press the mouse at one place and release it at another."""
        button = {"button": "left", "clickCount": 1}
        self._ask("Input.dispatchMouseEvent", type="mousePressed", x=start[0], y=start[1], **button)
        for i in range(1, 5):
            x, y = (a + (b - a) * i / 4 for a, b in zip(start, end, strict=True))
            self._ask(
                "Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y, buttons=1, button="left"
            )
        self._ask("Input.dispatchMouseEvent", type="mouseReleased", x=end[0], y=end[1], **button)

    def wheel(self, x: float, y: float, amount: float) -> None:
        """Turn the wheel; a negative amount is upwards."""
        self._ask("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=amount)

    def press(self, key: str, text: str = "", *, shift: bool = False) -> None:
        """Press a key, by JavaScript's name for it."""
        codes = {"Enter": 13, " ": 32, "ArrowRight": 39, "ArrowLeft": 37, "Tab": 9, "Escape": 27}
        chosen: dict[str, Any] = {"key": key, "windowsVirtualKeyCode": codes.get(key, ord(key[0]))}
        chosen |= {"modifiers": 8} if shift else {}
        self._ask(
            "Input.dispatchKeyEvent", type="keyDown", **chosen, **({"text": text} if text else {})
        )
        self._ask("Input.dispatchKeyEvent", type="keyUp", **chosen)

    def middle(self, selector: str) -> dict[str, float]:
        """The middle of an element in the window, to which the page is scrolled."""
        script = f"""(() => {{
            const e = document.querySelector({json.dumps(selector)});
            e.scrollIntoView({{block: 'center'}});
            const b = e.getBoundingClientRect();
            return {{x: b.x + b.width / 2, y: b.y + b.height / 2}};
        }})()"""
        return self.evaluate(script)

    def screenshot(self, path: Path, *, whole: bool = False) -> None:
        """Save what the window shows, or the whole page, as PNG."""
        found = self._ask("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        path.write_bytes(base64.b64decode(found["data"]))

    def pdf(self, path: Path) -> None:
        """Print the page to a file."""
        found = self._ask("Page.printToPDF", printBackground=True)
        path.write_bytes(base64.b64decode(found["data"]))

    # -- the protocol ----------------------------------------------------------------------------------

    def _ask(self, method: str, **params: Any) -> dict[str, Any]:
        self._serial += 1
        message: dict[str, Any] = {"id": self._serial, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        self._send.write(json.dumps(message).encode() + b"\0")
        self._send.flush()
        while True:
            answer = self._read()
            if answer.get("id") == self._serial:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return answer["result"]

    def _read(self) -> dict[str, Any]:
        """The next message; events are noted."""
        parts: list[bytes] = []
        while (byte := self._receive.read(1)) != b"\0":
            if not byte:
                raise AssertionError("The browser has ended.")
            parts.append(byte)
        message: dict[str, Any] = json.loads(b"".join(parts))
        method, params = message.get("method", ""), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.messages.append(str(params["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            self.messages.append(str(params["args"]))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            self.messages.append(str(params["entry"]))
        elif method == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])
        return message


@contextmanager
def browser() -> Iterator[Browser]:
    """A browser that runs until the end of the block."""
    program = need_browser()
    to_read, to_send = os.pipe()
    to_receive, to_write = os.pipe()
    script = f'exec "$0" "$@" 3<&{to_read} 4>&{to_write}'
    options = [
        "--headless=new",
        "--no-sandbox",
        "--remote-debugging-pipe",
        "--hide-scrollbars",
        "--disable-gpu",
    ]
    with TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = subprocess.Popen(
            ["bash", "-c", script, program, *options, f"--user-data-dir={profile}"],
            pass_fds=(to_read, to_write),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(to_read)
        os.close(to_write)
        with os.fdopen(to_send, "wb") as send, os.fdopen(to_receive, "rb") as receive:
            try:
                yield Browser(send, receive)
            finally:
                process.terminate()
                process.wait(timeout=20)
