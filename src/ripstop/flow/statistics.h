// Statistics of the mean of a fluctuating record: end of the start-up, mean, and uncertainty for values that
// are correlated in time.
#pragma once

#include <vector>

namespace ripstop::inline flow {

/// A quantity that is constant from one time to the next; times increase.
struct Record {
  std::vector<double> until;   // end of each interval [s]; the first one begins at `begin`
  std::vector<double> values;  // the mean over it
  double begin = 0;            // [s]

  double end() const { return until.empty() ? begin : until.back(); }
};

/// Means over equal parts of the time from `from` to the end, exact for the record. Throws Error(usage) for
/// fewer than one part or a time that the record does not reach.
std::vector<double> means_over_parts(const Record& record, double from, int parts);

/// When the start-up ends: the time that leaves the mean of the rest with the least standard error if its parts
/// were independent (MSER; White 1997), sought in the first half of the record.
double end_of_start_up(const Record& record);

struct MeanOverTime {
  double mean = 0;
  double standard_error = 0;  // infinite for a record without variation in time
  double deviation = 0;       // standard deviation of the record itself
};
/// Of the record from `from` on. The standard error is that of the means over equal parts of it, the largest
/// for six and more parts: parts shorter than the correlation time of the flow underestimate the error
/// (blocking; Flyvbjerg and Petersen 1989).
MeanOverTime mean_over_time(const Record& record, double from);

/// The frequency [1/s] with the most power, of a few records of the same times together, and the share of the power
/// within one step of frequency of it; 0 where the record is shorter than four periods of it.
struct Peak {
  double frequency = 0, share = 0;
};
Peak strongest_frequency(const std::vector<Record>& records, double from);

}  // namespace ripstop::inline flow
