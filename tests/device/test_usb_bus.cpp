// USB devices, as the kernel's files have them.
#include "device/usb_bus.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "temp_folder.h"

namespace hl::test_usb_bus {
namespace {

/// A folder like the kernel's, with what is put into it.
class FakeBus {
 public:
  explicit FakeBus(const std::string& name) : folder_(test::tempFile(name)) { std::filesystem::remove_all(folder_); }
  void add(const std::string& place, const std::vector<std::pair<std::string, std::string>>& files) const {
    const std::filesystem::path folder = folder_ / "devices" / place;
    std::filesystem::create_directories(folder);
    for (const auto& [file, text] : files) std::ofstream(folder / file) << text << '\n';
  }
  void addNode(const std::string& bus, const std::string& device) const {
    std::filesystem::create_directories(folder_ / "dev" / bus);
    std::ofstream(folder_ / "dev" / bus / device) << "";
  }
  std::vector<UsbDevice> devices() const { return usbDevices(folder_ / "devices", folder_ / "dev"); }

 private:
  std::filesystem::path folder_;
};

TEST(UsbBus, DevicesAreThereWithTheirNamesAndHubsAndInterfacesAreNot) {
  const FakeBus bus("usb_names");
  bus.add("usb1", {{"idVendor", "1d6b"}, {"idProduct", "0002"}, {"bDeviceClass", "09"}});
  bus.add("1-1:1.0", {{"bInterfaceClass", "ff"}});
  bus.add("1-1", {{"idVendor", "0403"},
                  {"idProduct", "cb48"},
                  {"bDeviceClass", "00"},
                  {"busnum", "1"},
                  {"devnum", "12"},
                  {"manufacturer", "Novint"},
                  {"product", "Falcon HAPTIC"}});
  bus.addNode("001", "012");
  const auto devices = bus.devices();
  ASSERT_EQ(devices.size(), 1U);
  EXPECT_EQ(textOf({devices[0].vendor, devices[0].product}), "0403:cb48");
  EXPECT_EQ(devices[0].name, "Novint Falcon HAPTIC");
  EXPECT_TRUE(devices[0].may_be_used);
}

TEST(UsbBus, ADeviceWithoutANodeOfThisUserMayNotBeUsed) {
  const FakeBus bus("usb_rights");
  bus.add("2-3", {{"idVendor", "1451"}, {"idProduct", "0402"}, {"busnum", "2"}, {"devnum", "5"}});
  ASSERT_EQ(bus.devices().size(), 1U);
  EXPECT_FALSE(bus.devices()[0].may_be_used);
}

TEST(UsbBus, AMachineWithoutUsbHasNone) { EXPECT_TRUE(usbDevices("/nonexistent", "/nonexistent").empty()); }

TEST(UsbBus, IdsMatchOneProductOrAllOfAVendor) {
  const UsbDevice omega{0x1451, 0x0402, "", true};
  EXPECT_TRUE(matches({0x1451, {}}, omega));
  EXPECT_TRUE(matches({0x1451, 0x0402}, omega));
  EXPECT_FALSE(matches({0x1451, 0x0403}, omega));
  EXPECT_EQ(textOf({0x1451, {}}), "1451:*");
}

TEST(UsbBus, TheRuleNamesTheDevice) {
  EXPECT_EQ(udevRuleFor({0x0403, 0xcb48}),
            "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", "
            "MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"");
}

}  // namespace
}  // namespace hl::test_usb_bus
