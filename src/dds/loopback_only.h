// Loopback only: unless it is said otherwise, in a program with this file, bind() ties each socket of the internet to
// the device lo. It hears what is sent to 127.0.0.1 and no more, and what it sends stays on the machine, whichever of
// the machine's addresses it goes to. So Cyclone DDS may send the machine's own address, at which programs expect their
// neighbours by default, and can neither hear another machine nor speak to one.
#pragma once

namespace hl {

/// For the sockets to come, of a program that DDS Security guards: they are as others. Before there are threads.
void leaveLoopback();

/// Throws hl::Error when a socket of this process is not tied to lo.
void requireLoopbackOnly();

}  // namespace hl
