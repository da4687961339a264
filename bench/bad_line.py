#!/usr/bin/env python3
"""A TCP relay that is a bad line: delay, jitter and loss for each packet, in both directions.

    bench/bad_line.py LISTEN_PORT HOST PORT [--delay MS] [--jitter MS] [--loss PERCENT]

A lost packet comes one retransmission later (twice the delay and 10 ms), and all behind it wait for it, as in TCP.
"""
import argparse
import asyncio
import random

PACKET_BYTES = 1448  # of an Ethernet frame's TCP payload


async def carry(reader, writer, line):
    """Reads packets as they come and writes each when it is due, in order."""
    loop = asyncio.get_running_loop()
    queue = asyncio.Queue(maxsize=20_000)  # some 29 MB on the line

    async def deliver():
        while (item := await queue.get()) is not None:
            due, packet = item
            await asyncio.sleep(max(0.0, due - loop.time()))
            writer.write(packet)
            await writer.drain()
        writer.close()

    task = asyncio.create_task(deliver())
    due = 0.0
    try:
        while packet := await reader.read(PACKET_BYTES):
            way = line.delay + random.uniform(-line.jitter, line.jitter)
            if random.random() < line.loss:
                way += 2 * line.delay + 0.010
            due = max(due, loop.time() + way)
            await queue.put((due, packet))
    except ConnectionError:
        pass
    await queue.put(None)
    await asyncio.gather(task, return_exceptions=True)


async def serve(line):
    async def connected(reader, writer):
        far_reader, far_writer = await asyncio.open_connection(line.host, line.port)
        await asyncio.gather(carry(reader, far_writer, line), carry(far_reader, writer, line))

    server = await asyncio.start_server(connected, "127.0.0.1", line.listen_port)
    async with server:
        await server.serve_forever()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("listen_port", type=int)
    parser.add_argument("host")
    parser.add_argument("port", type=int)
    parser.add_argument("--delay", type=float, default=20, help="ms, one way")
    parser.add_argument("--jitter", type=float, default=5, help="ms, more or less")
    parser.add_argument("--loss", type=float, default=1, help="percent of packets")
    line = parser.parse_args()
    line.delay, line.jitter, line.loss = line.delay / 1e3, line.jitter / 1e3, line.loss / 100
    asyncio.run(serve(line))


if __name__ == "__main__":
    main()
