#include "ripstop/flow/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop::inline flow {
namespace {

struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const double* values, std::size_t count) {
  Moments m;
  for (std::size_t i = 0; i < count; ++i) m.mean += values[i] / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double off = values[i] - m.mean;
    m.variance += off * off / static_cast<double>(count - 1);
  }
  return m;
}

}  // namespace

std::vector<double> means_over_parts(const Record& record, double from, int parts) {
  if (parts < 1 || !(from < record.end()))
    throw Error(ExitCode::usage,
                fmt::format("{} parts of a record that ends at {} s, from {} s", parts, record.end(), from));
  // The integral of the record at the ends of the parts, linear within an interval.
  std::vector<double> means(static_cast<std::size_t>(parts), 0.0);
  const double width = (record.end() - from) / parts;
  double begin = record.begin, whole = 0, last = 0;
  int part = -1;  // the end of the next one; -1: the beginning of the first
  for (std::size_t n = 0; n < record.values.size(); ++n) {
    const double end = record.until[n];
    for (; part < parts && from + (part + 1) * width <= end; ++part) {
      const double here = whole + std::max(0.0, from + (part + 1) * width - begin) * record.values[n];
      if (part >= 0) means[part] = (here - last) / width;
      last = here;
    }
    whole += (end - begin) * record.values[n];
    begin = end;
  }
  if (part < parts) means.back() = (whole - last) / width;  // the last end, but for rounding
  return means;
}

double end_of_start_up(const Record& record) {
  constexpr int parts = 200;
  const std::vector<double> means = means_over_parts(record, record.begin, parts);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int cut = 0; cut <= parts / 2; ++cut) {
    const int left = parts - cut;
    const double square = moments(means.data() + cut, static_cast<std::size_t>(left)).variance / left;
    if (square < least) least = square, best = cut;
  }
  return record.begin + best * (record.end() - record.begin) / parts;
}

MeanOverTime mean_over_time(const Record& record, double from) {
  MeanOverTime result;
  double largest = 0;
  for (const int parts : {6, 8, 12, 16, 24, 32, 48, 64}) {
    const std::vector<double> means = means_over_parts(record, from, parts);
    const Moments m = moments(means.data(), means.size());
    result.mean = m.mean;
    largest = std::max(largest, std::sqrt(m.variance / parts));
  }
  result.standard_error = largest > 0 ? largest : std::numeric_limits<double>::infinity();
  const std::vector<double> fine = means_over_parts(record, from, 500);
  result.deviation = std::sqrt(moments(fine.data(), fine.size()).variance);
  return result;
}

Peak strongest_frequency(const std::vector<Record>& records, double from) {
  constexpr int parts = 512;
  const double length = records.front().end() - from;
  std::vector<double> power(parts / 2, 0.0);
  for (const Record& record : records) {
    std::vector<double> values = means_over_parts(record, from, parts);
    const double mean = moments(values.data(), values.size()).mean;
    for (int n = 0; n < parts; ++n) {  // Hann's window
      const double s = std::sin(std::numbers::pi * (n + 0.5) / parts);
      values[n] = (values[n] - mean) * s * s;
    }
    for (int f = 1; f < parts / 2; ++f) {
      double re = 0, im = 0;
      for (int n = 0; n < parts; ++n) {
        const double angle = 2 * std::numbers::pi * f * n / parts;
        re += values[n] * std::cos(angle), im += values[n] * std::sin(angle);
      }
      power[f] += re * re + im * im;
    }
  }
  double all = 0;
  for (const double p : power) all += p;
  const auto top = static_cast<int>(std::max_element(power.begin(), power.end()) - power.begin());
  if (!(all > 0) || top < 4) return {};
  const double near = power[top - 1] + power[top] + (top + 1 < parts / 2 ? power[top + 1] : 0);
  return {top / length, near / all};
}

}  // namespace ripstop::inline flow
