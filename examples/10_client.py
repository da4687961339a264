#!/usr/bin/env python3
"""A square to touch from Python, without libhl: JSON over a WebSocket (docs/protocol.md).

    10_client.py [URL [SECONDS]]        URL: ws://HOST:PORT/hl; default ws://127.0.0.1:1997/hl, an hld or hl touch

Needs python3-websockets.
"""
import asyncio
import json
import sys

import websockets

SQUARE = {"vertices": [-.05, 0, -.05, .05, 0, -.05, .05, 0, .05, -.05, 0, .05], "polygons": [{"vertices": [0, 3, 2, 1]}]}


async def touch(url):
    async with websockets.connect(url, max_queue=None) as server:
        await server.send(json.dumps({"open": {"protocol_version": 1, "client_name": "10_client", "state_rate_Hz": 10}}))
        square = {"primitives": SQUARE, "material": {"static_friction": 0.4, "dynamic_friction": 0.2}, "name": 7}
        await server.send(json.dumps({"frame": {"number": 1, "world": {"items": [square]}}}))
        async for message in server:
            reply = json.loads(message)
            if "event" in reply and reply["event"]["kind"] == "TOUCH":
                print("touching: name", reply["event"]["name"], flush=True)
            if "refusal" in reply:
                print("refused:", reply["refusal"]["text"], file=sys.stderr)


if __name__ == "__main__":
    url = sys.argv[1] if len(sys.argv) > 1 else "ws://127.0.0.1:1997/hl"
    try:
        asyncio.run(asyncio.wait_for(touch(url), float(sys.argv[2]) if len(sys.argv) > 2 else 10))
    except asyncio.TimeoutError:
        pass  # it has been touched long enough
    except OSError as error:
        sys.exit(f"10_client.py: {error}; is hld running?")
