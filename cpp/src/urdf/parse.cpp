#include "urdf/parse.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "urdf/rewrite.hpp"

namespace saltus::reader {
namespace {

/// urdfdom reports through console_bridge, one sink for the whole process: borrowed while parsing.
class Capture final : public console_bridge::OutputHandler {
 public:
  Capture() : level_(console_bridge::getLogLevel()), sink_(console_bridge::getOutputHandler()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    console_bridge::useOutputHandler(this);
  }
  ~Capture() override {
    console_bridge::useOutputHandler(sink_);
    console_bridge::setLogLevel(level_);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    messages += (messages.empty() ? "" : "; ") + text;
  }

  std::string messages;

 private:
  console_bridge::LogLevel level_;
  console_bridge::OutputHandler* sink_;
};

}  // namespace

std::shared_ptr<urdf::ModelInterface> parse(const Document& document) {
  static std::mutex one_at_a_time;
  const std::string text = rewrite(document);
  const std::lock_guard lock(one_at_a_time);
  Capture capture;
  std::shared_ptr<urdf::ModelInterface> model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::runtime_error& error) {  // as urdf::ParseError
    capture.log(error.what(), console_bridge::CONSOLE_BRIDGE_LOG_ERROR, "", 0);
  }
  // urdfdom reports a shape or a number it could not read, and goes on without it
  if (model != nullptr && capture.messages.empty()) return model;
  throw ModelError(document.label() + ": urdfdom says: " + capture.messages);
}

}  // namespace saltus::reader
