// DdsReach: how far what is published by DDS goes, and in which domain.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hl {

struct DdsReach {
  std::string interface_name = "lo";  ///< of the network; lo: this machine
  std::string enclave;                ///< a folder, see enclave.h; empty: no DDS Security
  std::vector<std::string> peers;     ///< IPv4 addresses at which others are, where multicast does not find them
};

/// What uses DDS, in the words of a person.
struct DdsUse {
  const char* option;  ///< the options of its reach begin so
  const char* danger;  ///< what anybody could do without keys
};
inline constexpr DdsUse kRosUse{"--ros", "pull the hand"}, kShareUse{"--share", "change the scene in the hand"};

/// Throws hl::Error where others than this machine could be reached without DDS Security, where there is no such
/// interface, and for peers that are no addresses or cannot be reached.
void checkReach(const DdsReach& reach, const DdsUse& use);

/// The words with which a program is given its reach; and the reach of the first words of these, up to the first that
/// is of none, which `word` is at then. False: they make no sense. It is not checked.
std::vector<std::string> wordsOf(const DdsReach& reach);
bool readReach(const std::vector<std::string>& words, std::vector<std::string>::const_iterator& word, DdsReach& reach);

/// The largest domain: more have no UDP ports (DDSI-RTPS 9.6.1.1).
inline constexpr std::uint32_t kMaxDdsDomain = 232;
/// A domain that somebody has written. Throws hl::Error, which says `what` it is.
std::uint32_t ddsDomainOf(const std::string& text, const char* what);
/// What ROS_DOMAIN_ID says; 0 where it is not set. Throws hl::Error.
std::uint32_t ddsDomain();

}  // namespace hl
