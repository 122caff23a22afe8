// The server of Studio: on the loopback interface only, for the page that it serves itself.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace ripstop::inline studio {

/// Requests need a random token, this server's own Host and no other Origin; bodies are JSON of at most 2 MiB, or 24 MiB of
/// tensile records.
class StudioServer {
 public:
  /// `program`: path of this program, for the child processes. `port` 0: a free one. Throws Error(usage) for a folder
  /// that cannot be used, Error(io) for a port that is taken.
  StudioServer(const std::filesystem::path& folder, const std::string& program, int port);
  ~StudioServer();
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  /// "http://127.0.0.1:40123/?token=..."
  std::string address() const;
  /// Serves until stop().
  void serve();
  /// Until another thread serves.
  void wait_until_ready() const;
  /// From any thread.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The page with its scripts; only scripts with the nonce run.
std::string studio_page(const std::string& nonce);

/// JSON {"types": {type: SVG}, "families": {name of an example: type}}.
std::string studio_drawings();

}  // namespace ripstop::inline studio
