// Replays seeds and mutations of them through one reader, the same ones every time:
//
//     fuzz_replay_case COUNT SEED...        (files, or folders of files)
//
// Ends with 1 when an input crashes the reader, throws what is no Error, takes more than `slowest` or when all of
// them together took more than `most_memory`; the input is then in the file find-<reader>.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "reader.h"

namespace {

using Bytes = std::string;
namespace fs = std::filesystem;

constexpr double slowest = 10;         // [s]; sanitizers and other work beside it included
constexpr long most_memory = 1 << 20;  // [kB]
constexpr std::size_t longest = 1 << 16;

Bytes now;              // what is being read
std::string find_name;  // where it goes if it is a find

/// Only calls that a signal handler may make.
void keep_find() {
  const int fd = open(find_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  [[maybe_unused]] const auto written = write(fd, now.data(), now.size());
  close(fd);
}
void crashed(int number) {
  keep_find();
  signal(number, SIG_DFL);
  raise(number);
}

std::vector<Bytes> read_seeds(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int i = 2; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) {
      files.emplace_back(argv[i]);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Bytes> seeds;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) {
      std::fprintf(stderr, "%s cannot be read\n", file.c_str());
      std::exit(2);
    }
    seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutator {
 public:
  explicit Mutator(const std::vector<Bytes>& seeds) : seeds_(seeds) {}

  Bytes next() {
    Bytes bytes = seeds_[below(seeds_.size())];
    for (std::size_t i = 1 + below(6); i > 0; --i) change(bytes);
    if (bytes.size() > longest) bytes.resize(longest);
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void change(Bytes& bytes) {
    static const char* const tokens[] = {"nan",     "inf", "-1", "0", "1e308", "1e-308", "99999999999",
                                         "\x1b[2J", "[",   "]",  "{", "}",     "(",      ")",
                                         "\"",      ",",   "\n", "=", "\xff",  "[["};
    const std::size_t at = below(bytes.size() + 1), length = 1 + below(16);
    switch (below(7)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        return;
      case 1:
        bytes.insert(at, 1, static_cast<char>(below(256)));
        return;
      case 2:
        bytes.erase(at, below(4) ? length : bytes.size());  // now and then all that follows
        return;
      case 3:
        bytes.insert(at, tokens[below(std::size(tokens))]);
        return;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size() + 1), 4 * length));  // twice
        return;
      case 5:
        change_number(bytes, at);
        return;
      default: {
        const Bytes& other = seeds_[below(seeds_.size())];
        bytes = bytes.substr(0, at) + other.substr(below(other.size() + 1));
      }
    }
  }

  /// The number that comes next is another one.
  void change_number(Bytes& bytes, std::size_t at) {
    static const char* const numbers[] = {"0",          "-1",  "1e300", "1e-300",
                                          "2147483648", "nan", "0.5",   "1000000"};
    const std::size_t begin = bytes.find_first_of("0123456789", at);
    if (begin == Bytes::npos) return;
    const std::size_t end = bytes.find_first_not_of("0123456789.eE+-", begin);
    bytes.replace(begin, std::min(end, bytes.size()) - begin, numbers[below(std::size(numbers))]);
  }

  const std::vector<Bytes>& seeds_;
  std::mt19937_64 random_{20};
};

/// False for a find.
bool run_one() {
  const auto begin = std::chrono::steady_clock::now();
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(now.data()), now.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "threw what is no ripstop::Error: %s\n", error.what());
    return false;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (seconds > slowest) std::fprintf(stderr, "took %.1f s\n", seconds);
  return seconds <= slowest;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "%s COUNT SEED...\n", argv[0]);
    return 2;
  }
  find_name = "find-" + fs::path(argv[0]).filename().string();
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) signal(number, crashed);
  const std::vector<Bytes> seeds = read_seeds(argc, argv);
  if (seeds.empty()) {
    std::fprintf(stderr, "no seeds\n");
    return 2;
  }
  const long count = std::atol(argv[1]);
  const auto begin = std::chrono::steady_clock::now();
  Mutator mutator(seeds);
  for (long i = 0; i < count + static_cast<long>(seeds.size()); ++i) {
    now = i < static_cast<long>(seeds.size()) ? seeds[static_cast<std::size_t>(i)] : mutator.next();
    if (run_one()) continue;
    keep_find();
    std::fprintf(stderr, "the input is in %s\n", find_name.c_str());
    return 1;
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::printf("%zu seeds and %ld mutations in %.1f s, at most %ld MB\n", seeds.size(), count,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
              used.ru_maxrss / 1024);
  return used.ru_maxrss > most_memory ? 1 : 0;
}
