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

/// The beauty so far in a file, each time a whole one. A file that cannot be written is no reason
/// to stop a render, nor to lose its end: that is told once.
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

/// A picture in tev, or in any program that speaks the same.
class TevClient {
  public:
    /// `address` is "host:port", or a host alone, then at port 14158. Throws InputError where
    /// nobody listens. `name` is what the picture is called there.
    TevClient(std::string const& address, std::string name);
    TevClient(TevClient const&) = delete;
    TevClient& operator=(TevClient const&) = delete;
    ~TevClient();

    /// Sends the beauty. A viewer that is gone is no reason to stop a render: it is told once.
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
