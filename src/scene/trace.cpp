#include "src/scene/trace.h"

#include "src/scene/quote.h"

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <ostream>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Appends a number without a temporary string: a trace writes millions of them.
template <typename Value>
void appendNumber(std::string& buffer, Value value) {
  char digits[32];
  if constexpr (std::is_floating_point_v<Value>) {
    if (std::isnan(value)) value = std::abs(value); // processors differ in the sign of what they make
  }
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  static_cast<void>(error); // 32 characters hold every shortest double and every 64-bit integer
  buffer.append(digits, end);
}

/// A double as JSON has it; the values that JSON cannot write become null (RFC 8259, section 6).
void appendJsonNumber(std::string& buffer, double value) {
  if (std::isfinite(value)) {
    appendNumber(buffer, value);
  } else {
    buffer += "null";
  }
}

/// RFC 4180: a field that holds a comma, a quote or a line break stands in quotes, quotes doubled.
std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char letter : text) {
    if (letter == '"') field += '"';
    field += letter;
  }
  return field + '"';
}

/// RFC 8259, section 7.
std::string jsonString(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      result += '\\';
      result += letter;
    } else if (static_cast<unsigned char>(letter) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(letter));
    } else {
      result += letter;
    }
  }
  return result + '"';
}

void flush(std::ostream& out, std::string& buffer) {
  out.write(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  buffer.clear(); // keeps its memory for the next frame
}

} // namespace

TraceWriter::TraceWriter(std::ostream& out, TraceFormat format, std::vector<std::string> groups)
    : out_(out), format_(format), groups_(std::move(groups)) {
  for (std::string& group : groups_)
    group = format_ == TraceFormat::Csv ? csvField(group) : jsonString(group);
  if (format_ == TraceFormat::Csv) out_ << "frame,id,time,x,y,vx,vy,radius,group\n";
}

void TraceWriter::write(const World& world) {
  write(world.frame(), world.time(), world.bodies());
}

void TraceWriter::write(std::int64_t frame, double time, std::span<const Body> bodies) {
  const bool json = format_ == TraceFormat::JsonLines;
  const auto column = [this, json](std::string_view jsonKey, double value) {
    if (json) {
      buffer_ += jsonKey;
      appendJsonNumber(buffer_, value);
    } else {
      buffer_ += ',';
      appendNumber(buffer_, value);
    }
  };
  for (const Body& body : bodies) {
    buffer_ += json ? "{\"frame\":" : "";
    appendNumber(buffer_, frame);
    buffer_ += json ? ",\"id\":" : ",";
    appendNumber(buffer_, body.id);
    column(",\"time\":", time);
    column(",\"x\":", body.position.x());
    column(",\"y\":", body.position.y());
    column(",\"vx\":", body.velocity.x());
    column(",\"vy\":", body.velocity.y());
    column(",\"radius\":", body.radius);
    buffer_ += json ? ",\"group\":" : ",";
    buffer_ += groups_.at(body.group);
    buffer_ += json ? "}\n" : "\n";
  }
  flush(out_, buffer_);
}

EventWriter::EventWriter(std::ostream& out, TraceFormat format) : out_(out), format_(format) {
  if (format_ == TraceFormat::Csv) out_ << "frame,event,id1,id2,time,p,q\n";
}

void EventWriter::write(const World& world) {
  for (const Event& event : world.events()) {
    if (format_ == TraceFormat::Csv) {
      appendNumber(buffer_, event.frame);
      buffer_ += ',';
      buffer_ += name(event.kind);
      for (const std::int64_t id : {event.first, event.second}) {
        buffer_ += ',';
        appendNumber(buffer_, id);
      }
      for (const double value : {event.time, event.p, event.q}) {
        buffer_ += ',';
        appendNumber(buffer_, value);
      }
    } else {
      buffer_ += "{\"frame\":";
      appendNumber(buffer_, event.frame);
      buffer_ += ",\"event\":\"";
      buffer_ += name(event.kind);
      buffer_ += "\",\"id1\":";
      appendNumber(buffer_, event.first);
      buffer_ += ",\"id2\":";
      appendNumber(buffer_, event.second);
      buffer_ += ",\"time\":";
      appendJsonNumber(buffer_, event.time);
      buffer_ += ",\"p\":";
      appendJsonNumber(buffer_, event.p);
      buffer_ += ",\"q\":";
      appendJsonNumber(buffer_, event.q);
      buffer_ += '}';
    }
    buffer_ += '\n';
  }
  flush(out_, buffer_);
}

} // namespace offstage
