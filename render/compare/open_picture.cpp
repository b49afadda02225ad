#include "render/compare/compare_images.h"
#include "render/compare/frame_rows.h"
#include "render/compare/parallel.h"
#include "render/draw/file_bytes.h"
#include "render/draw/image.h"
#include "render/draw/png_reader.h"
#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace offstage {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ExitCode::BadInput, fmt::format("{} {}", quoted(file), reason));
}

std::vector<std::uint8_t> readPicture(const std::filesystem::path& file) {
  try {
    return readFileBytes(file, kLargestImageFile);
  } catch (const std::runtime_error& error) {
    const std::string reason = error.what();
    // A verb phrase ("is empty") goes on the name; a system's reason does not.
    fail(file, reason.starts_with("is ") ? reason : "cannot be read: " + reason);
  }
}

std::unique_ptr<PixelRows> decode(const std::filesystem::path& file, std::vector<std::uint8_t> bytes,
                                  std::int64_t maxPixels, std::vector<std::string>& notices) {
  try {
    if (isPng(bytes)) {
      auto picture = std::make_unique<PngPicture>(std::move(bytes), maxPixels);
      for (const std::string& notice : picture->notices()) notices.push_back(quoted(file) + " " + notice);
      return picture;
    }
    Image image = decodeImage(std::move(bytes));
    Frame frame;
    frame.width = image.width;
    frame.height = image.height;
    frame.rgba = std::move(image.rgba);
    auto picture = std::make_unique<FrameRows>(std::move(frame));
    if (static_cast<std::int64_t>(picture->width()) * picture->height() > maxPixels)
      fail(file, fmt::format("has {}x{} px, more than the limit of {} pixels", picture->width(),
                             picture->height(), maxPixels));
    return picture;
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
}

} // namespace

std::unique_ptr<PixelRows> openPicture(const std::filesystem::path& file, std::int64_t maxPixels,
                                       std::vector<std::string>& notices) {
  return decode(file, readPicture(file), maxPixels, notices);
}

std::pair<std::shared_ptr<PixelRows>, std::shared_ptr<PixelRows>>
openPictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
             std::int64_t maxPixels, std::vector<std::string>& notices) {
  std::array<std::vector<std::uint8_t>, 2> bytes{readPicture(expected), readPicture(actual)};
  const std::array<const std::filesystem::path*, 2> files{&expected, &actual};
  std::array<std::shared_ptr<PixelRows>, 2> pictures;
  std::array<std::vector<std::string>, 2> of;
  const bool equal = bytes[0] == bytes[1];
  if (equal) bytes[1] = {};
  parallelFor(equal ? 1 : 2, 1, 2, [&](int, int begin, int) {
    const auto i = static_cast<std::size_t>(begin);
    pictures.at(i) = decode(*files.at(i), std::move(bytes.at(i)), maxPixels, of.at(i));
  });
  if (equal) pictures[1] = pictures[0];
  for (const auto& list : of) notices.insert(notices.end(), list.begin(), list.end());
  return {pictures[0], pictures[1]};
}

} // namespace offstage
