#include "ros/governance.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "ros/ros_task.h"

namespace hl {

namespace {

using Tree = boost::property_tree::ptree;

std::string heading(const char* schema) {
  return std::string(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_)") +
         schema + ".xsd\">\n";
}

Tree treeOf(const std::string& text, const std::string& name) {
  Tree tree;
  std::istringstream in(text);
  try {
    boost::property_tree::read_xml(in, tree, boost::property_tree::xml_parser::trim_whitespace);
  } catch (const boost::property_tree::xml_parser_error& error) {
    throw Error(name + " is no XML: " + error.message());
  }
  return tree;
}

// <domains>: single ones, and ranges that may be open above.
bool holds(const Tree& domains, std::uint32_t domain) {
  for (const auto& [kind, value] : domains) {
    if (kind == "id" && value.get_value<std::uint32_t>(kMaxDdsDomain + 1) == domain) return true;
    if (kind == "id_range" && value.get<std::uint32_t>("min", 0) <= domain &&
        domain <= value.get<std::uint32_t>("max", kMaxDdsDomain))
      return true;
  }
  return false;
}

// What is said twice says nothing.
std::string said(const Tree& rule, const char* what) {
  return rule.count(what) == 1 ? rule.get<std::string>(what) : std::string();
}
bool isTrue(const Tree& rule, const char* what) {
  const std::string value = said(rule, what);
  return value == "true" || value == "TRUE" || value == "1";
}
bool isFalse(const Tree& rule, const char* what) {
  const std::string value = said(rule, what);
  return value == "false" || value == "FALSE" || value == "0";
}
// ENCRYPT, or ENCRYPT_WITH_ORIGIN_AUTHENTICATION.
bool encrypts(const Tree& rule, const char* what) { return said(rule, what).starts_with("ENCRYPT"); }

// What this rule leaves open, of which domains does not matter; empty: nothing.
std::string gapOf(const Tree& rule) {
  if (!isFalse(rule, "allow_unauthenticated_participants")) return "allow_unauthenticated_participants is not false";
  if (!isTrue(rule, "enable_join_access_control")) return "enable_join_access_control is not true";
  const auto topics = rule.get_child_optional("topic_access_rules");
  if (!topics || topics->count("topic_rule") == 0) return "there is no topic_rule";
  for (const auto& [kind, topic] : *topics) {
    if (kind != "topic_rule") continue;
    for (const char* control : {"enable_read_access_control", "enable_write_access_control"}) {
      if (!isTrue(topic, control)) return std::string(control) + " is not true for every topic";
    }
    if (!encrypts(rule, "rtps_protection_kind") && !encrypts(topic, "metadata_protection_kind") &&
        !encrypts(topic, "data_protection_kind"))
      return "neither rtps_protection_kind, metadata_protection_kind nor data_protection_kind is ENCRYPT for every "
             "topic";
  }
  return {};
}

}  // namespace

std::string governanceText() {
  return heading("governance") + R"(  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>)" +
         std::to_string(kMaxKeysDomain) + R"(</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

std::string permissionsText(const std::string& enclave, std::uint32_t domain, const std::string& begin,
                            const std::string& end) {
  const std::string all = "<topics><topic>*</topic></topics>";
  std::ostringstream out;
  out << heading("permissions") << "  <permissions>\n    <grant name=\"" << enclave
      << "\">\n      <subject_name>CN=" << enclave << "</subject_name>\n      <validity><not_before>" << begin
      << "</not_before><not_after>" << end << "</not_after></validity>\n      <allow_rule>\n        <domains><id>"
      << domain << "</id></domains>\n        <publish>" << all << "</publish>\n        <subscribe>" << all
      << "</subscribe>\n      </allow_rule>\n      <default>DENY</default>\n    </grant>\n  </permissions>\n</dds>\n";
  return out.str();
}

void requireProtection(const std::string& governance, std::uint32_t domain, const std::string& name) {
  const Tree tree = treeOf(governance, name);
  const auto rules = tree.get_child_optional("dds.domain_access_rules");
  if (!rules) throw Error(name + " has no domain_access_rules: it is no governance of DDS Security");
  // The first rule of a domain counts.
  for (const auto& [kind, rule] : *rules) {
    if (kind != "domain_rule" || !holds(rule.get_child("domains", {}), domain)) continue;
    if (const std::string gap = gapOf(rule); !gap.empty())
      throw Error(name + " does not protect domain " + std::to_string(domain) + ": " + gap +
                  "; sign one that does, as hl keys and ros2 security make it");
    return;
  }
  throw Error(name + " says nothing of domain " + std::to_string(domain) +
              ": sign one that does, or set ROS_DOMAIN_ID");
}

}  // namespace hl
