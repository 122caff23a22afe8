#include "ripstop/report/encode.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace ripstop::inline report {
namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), 6) != Z_OK)
    throw std::bad_alloc();  // the only failure left when the buffer is large enough
  packed.resize(size);
  return packed;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string pack_integers(const std::vector<std::uint32_t>& values, int components, int bytes) {
  std::string planes(values.size() * static_cast<std::size_t>(bytes), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t before = static_cast<std::size_t>(components);
    const std::uint32_t change = values[i] - (i < before ? 0U : values[i - before]);
    for (int b = 0; b < bytes; ++b)
      planes[values.size() * static_cast<std::size_t>(b) + i] = static_cast<char>(change >> (8 * b) & 255);
  }
  return base64(deflated(planes));
}

Quantised quantise(const std::vector<double>& values, int components, int levels) {
  const auto count = static_cast<std::size_t>(components);
  Quantised result;
  result.values.resize(values.size());
  result.low.assign(count, std::numeric_limits<double>::infinity());
  std::vector<double> high(count, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    result.low[i % count] = std::min(result.low[i % count], values[i]);
    high[i % count] = std::max(high[i % count], values[i]);
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (!(result.low[c] <= high[c])) result.low[c] = high[c] = 0;
    result.step.push_back((high[c] - result.low[c]) / levels);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double step = result.step[i % count];
    const double number = step > 0 ? std::round((values[i] - result.low[i % count]) / step) : 0;
    result.values[i] = std::isfinite(values[i]) ? static_cast<std::uint32_t>(number) : no_number;
  }
  return result;
}

}  // namespace ripstop::inline report
