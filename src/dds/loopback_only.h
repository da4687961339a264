// Loopback only: in a program with this file, bind() of IPv4 ties each socket to the device lo, through which come the
// packets that programs of this machine send to any of its addresses, and no others. So Cyclone DDS may tell the
// machine's own address, as programs that are on it by default look for it there, and can neither hear another machine
// nor speak to one.
#pragma once

namespace hl {

/// Throws hl::Error when a socket of this process is not tied to lo.
void requireLoopbackOnly();

}  // namespace hl
