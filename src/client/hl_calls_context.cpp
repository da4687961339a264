// The calls about the context and its errors.
#include <hl/hl.h>

#include <exception>
#include <memory>
#include <string>

#include "client/call.h"
#include "client/server_url.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Conversation;
using hl::client::Fault;
using hl::client::When;

namespace {

std::string& connectError() {
  static thread_local std::string text;
  return text;
}

const char* textOf(HLcontext& context, HLenum name) {
  const hl::client::ServerView& view = context.conversation.view();
  switch (name) {
    case HL_VENDOR:
      return "HL";
    case HL_VERSION:
      return HL_LIBRARY_VERSION;
    case HL_SERVER_VERSION:
      return view.welcome().server_version().c_str();
    case HL_DEVICE_NAME:
      return view.device().name().c_str();
    case HL_DEVICE_LABEL:
      return view.device().label().c_str();
    case HL_FAULT:
      return view.state().safety() == hl::proto::FAULT ? view.state().fault().c_str() : "";
    case HL_ERROR_STRING:
      return context.errors.text().c_str();
    case HL_FRAME_WARNINGS:
      context.text.clear();
      for (const std::string& line : view.shown().warnings()) context.text += (context.text.empty() ? "" : "\n") + line;
      return context.text.c_str();
    default:
      throw Fault(HL_INVALID_ENUM, "not a text");
  }
}

const char* textOfDevice(HLcontext& context, HLenum name, HLuint number) {
  const auto& devices = context.conversation.view().welcome().devices();
  if (name != HL_DEVICE_NAME && name != HL_DEVICE_LABEL) throw Fault(HL_INVALID_ENUM, "not a text of a device");
  if (number >= static_cast<HLuint>(devices.size()))
    throw Fault(HL_INVALID_VALUE, "there is no such device: HL_DEVICE_COUNT says how many there are");
  const hl::proto::DeviceInfo& device = devices[static_cast<int>(number)];
  return name == HL_DEVICE_NAME ? device.name().c_str() : device.label().c_str();
}

void requireDestroyable(const HLcontext* context) {
  if (context->events.isDelivering()) throw Fault(HL_INVALID_OPERATION, "not in a callback of the context's hlPoll");
  if (context->current && context != hl::client::currentContext())
    throw Fault(HL_INVALID_OPERATION, "the context is current on another thread");
}

}  // namespace

HLcontext* hlCreateContext(const char* url) {
  try {
    connectError().clear();
    if (url == nullptr) throw Fault(HL_INVALID_VALUE, "the server's URL is a null pointer");
    return std::make_unique<HLcontext>(Conversation::open(hl::client::parseServerUrl(url))).release();
  } catch (const std::exception& error) {
    connectError() = error.what();
  } catch (...) {
    connectError() = "the link could not be opened";
  }
  return nullptr;
}

const char* hlGetConnectError(void) { return connectError().c_str(); }

HLboolean hlMakeCurrent(HLcontext* context) {
  try {
    if (const HLcontext* now = hl::client::currentContext()) requireAllowed(*now, When::kOutside);
    hl::client::setCurrentContext(context);
    return HL_TRUE;
  } catch (...) {
    noteCurrentException(hl::client::currentErrors(), __func__);
    return HL_FALSE;
  }
}

HLcontext* hlGetCurrentContext(void) { return hl::client::currentContext(); }

void hlDestroyContext(HLcontext* context) {
  if (context == nullptr || context->isOfAnotherProcess()) return;
  try {
    requireDestroyable(context);
    if (context == hl::client::currentContext()) hl::client::setCurrentContext(nullptr);
    delete context;
  } catch (...) {
    noteCurrentException(hl::client::currentErrors(), __func__);
  }
}

HLenum hlGetError(void) {
  if (hl::client::currentContext() == nullptr) return hl::client::threadErrors().take();
  return callOr<HLenum>(HL_NO_ERROR, __func__, When::kOutside,
                        [](HLcontext& context) { return context.errors.take(); });
}

void hlErrorFunc(HLerrorfunc callback, void* user) {
  call(__func__, [&](HLcontext& context) { context.errors.setCallback(callback, user); });
}

const char* hlGetString(HLenum name) {
  return callOr<const char*>(nullptr, __func__, When::kOutside,
                             [&](HLcontext& context) { return textOf(context, name); });
}

const char* hlGetStringi(HLenum name, HLuint device) {
  return callOr<const char*>(nullptr, __func__, When::kOutside,
                             [&](HLcontext& context) { return textOfDevice(context, name, device); });
}
