// Opens the page in the user's browser.
#pragma once

#include <string>

namespace hl {

/// Asks the desktop to show `address`; without a desktop nothing happens. The browser gets nothing of this program: no
/// descriptor, no blocked or ignored signal, no terminal; it stays when this program ends.
void openBrowser(const std::string& address);

}  // namespace hl
