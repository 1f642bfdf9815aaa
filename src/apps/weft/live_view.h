// Pictures of a render while it goes on: a PNG that is written over and over, and the viewer tev
// (github.com/Tom94/tev), which takes pictures over TCP.
#pragma once

#include <optional>
#include <string>

#include "post/display.h"
#include "session/render_state.h"

namespace weft::apps {

/// Where the user wants to see a render while it goes on; empty texts: nowhere.
struct LiveArguments {
    std::string watch; ///< a file
    std::string tev;   ///< "host:port"
};

/// Writes the beauty so far to a file, each time as a whole. Where the file cannot be written, a
/// warning says so once, and the render goes on.
class WatchedPicture {
  public:
    /// Throws InputError where `path` cannot be written.
    WatchedPicture(std::string path, post::DisplayChain chain);

    void show(image::Image const& beauty);
    /// Shows every two seconds.
    session::Watcher watcher();

  private:
    std::string path_;
    post::DisplayChain chain_;
    std::string told_; ///< the last failure
};

/// Shows the beauty so far in tev, or in any program that speaks its protocol.
class TevClient {
  public:
    /// Connects to `address`: "host:port", or a host alone for port 14158. `name` is what the
    /// picture is called there. Throws InputError where nobody listens.
    TevClient(std::string const& address, std::string name);
    TevClient(TevClient const&) = delete;
    TevClient& operator=(TevClient const&) = delete;
    ~TevClient();

    /// Sends the beauty. Where the viewer is gone, a warning says so once, and the render goes on.
    void show(film::Film const& film);
    /// Shows every second.
    session::Watcher watcher();

  private:
    bool send(std::string const& packet);

    std::string name_;
    int socket_ = -1;
    bool created_ = false;
};

/// All views of one render that the user asked for.
class LiveViews {
  public:
    /// Throws InputError as the views do. `name` is what the picture is called.
    LiveViews(LiveArguments const& arguments, post::DisplayChain const& chain,
              std::string const& name);

    /// Adds watchers that refer to this object.
    void watch(std::vector<session::Watcher>& watchers);
    /// Shows the last state of the render.
    void show(film::Film const& film);

  private:
    std::optional<WatchedPicture> file_;
    std::optional<TevClient> tev_;
};

} // namespace weft::apps
