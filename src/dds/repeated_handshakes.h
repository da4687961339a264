// Repeated handshakes: DDS Security on a line that loses packets. Cyclone DDS 0.10 sends the last message of a
// handshake once: when that is lost, one side takes both for known to each other, and the other one waits for it in
// vain, for good. So, once it is asked for, in a program with this file sendmsg() sends each datagram with a message of
// a handshake several times. Who gets it takes one of a number, and leaves out the others.
#pragma once

namespace hl {

/// Of each datagram. Where one in twenty is lost, all are lost one time in 160 000.
inline constexpr int kHandshakeCopies = 4;

/// From now on. Before there are threads.
void repeatHandshakes();

}  // namespace hl
