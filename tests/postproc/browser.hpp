#pragma once

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/fresh_folder.hpp"

namespace cupola::test {

inline bool on_path(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// True if a test that needs Chromium can run. Continuous integration sets CUPOLA_REQUIRE_BROWSER, so that
/// the test runs there in any case.
inline bool has_browser() {
  return std::getenv("CUPOLA_REQUIRE_BROWSER") != nullptr || on_path("chromium");
}

/// Headless Chromium without network, which draws by software. It is driven through two pipes, with messages
/// in JSON that end with a zero byte (https://chromedevtools.github.io/devtools-protocol,
/// --remote-debugging-pipe).
class Browser {
 public:
  using Json = nlohmann::json;

  Browser() {
    start(fresh_folder("browser"));
    const Json targets = send("Target.getTargets");
    for (const Json& target : targets["targetInfos"])
      if (target["type"] == "page")
        session_ =
            send("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
    EXPECT_FALSE(session_.empty());
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) send(std::string(domain) + ".enable");
    send("Network.emulateNetworkConditions",
         {{"offline", true}, {"latency", 0}, {"downloadThroughput", -1}, {"uploadThroughput", -1}});
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() {
    closing_ = true;
    session_.clear();
    send("Browser.close");
    ::close(to_);
    ::close(from_);
    if (!running_) ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  void resize(int width, int height, bool dark) {
    send("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    const Json scheme{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
    send("Emulation.setEmulatedMedia", {{"features", Json::array({scheme})}});
  }

  void open(const std::string& file) { open_address("file://" + file); }

  /// An empty light page of 1280 x 900 pixels without complaints; a page of before is gone. Call it first.
  void start_anew() {
    resize(1280, 900, false);
    open_address("about:blank");
    complaints_.clear();
  }
  bool runs() const { return running_; }

  /// The value of an expression of the page; a promise is awaited.
  Json value(const std::string& expression) {
    const Json answer = send("Runtime.evaluate",
                             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    EXPECT_FALSE(answer.contains("exceptionDetails")) << expression << "\n" << answer.dump();
    return answer.contains("result") && answer["result"].contains("value") ? answer["result"]["value"]
                                                                           : Json();
  }

  void click(double x, double y) {
    for (const char* type : {"mousePressed", "mouseReleased"})
      send("Input.dispatchMouseEvent",
           {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 1}, {"clickCount", 1}});
  }

  /// Errors and warnings of the pages so far, and what they printed.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  void open_address(const std::string& address) {
    loaded_ = false;
    send("Page.navigate", {{"url", address}});
    while (!loaded_ && running_) receive();
  }

  void start(const std::string& profile) {
    int to[2], from[2];
    ASSERT_EQ(::pipe2(to, O_CLOEXEC) + ::pipe2(from, O_CLOEXEC), 0);
    const std::string folder = "--user-data-dir=" + profile;
    std::signal(SIGPIPE, SIG_IGN);  // a Chromium that died is an error, not the end of the tests
    process_ = ::fork();
    if (process_ == 0) {
      // Chromium reads from descriptor 3 and writes to 4; copies first, because the pipes may have these
      // numbers.
      const int reads = ::dup(to[0]), writes = ::dup(from[1]), quiet = ::open("/dev/null", O_WRONLY);
      ::dup2(quiet, 2);
      ::dup2(::fcntl(reads, F_DUPFD, 10), 3);
      ::dup2(::fcntl(writes, F_DUPFD, 10), 4);
      ::execlp("chromium", "chromium", "--headless", "--no-sandbox", "--no-first-run",
               "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
               "--remote-debugging-pipe", folder.c_str(), "about:blank", nullptr);
      ::_exit(127);
    }
    ::close(to[0]);
    ::close(from[1]);
    to_ = to[1], from_ = from[0];
  }

  Json send(const std::string& method, const Json& parameters = Json::object()) {
    asked_ = method + parameters.dump();
    Json message{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump() + '\0';
    for (size_t done = 0; done < text.size() && running_;) {
      const ssize_t n = ::write(to_, text.data() + done, text.size() - done);
      if (n <= 0) return fail();
      done += static_cast<size_t>(n);
    }
    answer_ = nullptr;
    while (answer_.is_null() && running_) receive();
    return answer_;
  }

  /// Takes one message: the answer to the last command, or an event.
  void receive() {
    size_t end = 0;
    while ((end = buffer_.find('\0')) == std::string::npos) {
      constexpr int kPatience = 120'000;  // ms; drawing by software takes seconds on a busy machine
      pollfd ready{from_, POLLIN, 0};
      char bytes[65536];
      const ssize_t n = ::poll(&ready, 1, kPatience) == 1 ? ::read(from_, bytes, sizeof bytes) : 0;
      if (n <= 0) {
        fail();
        return;
      }
      buffer_.append(bytes, static_cast<size_t>(n));
    }
    const Json message = Json::parse(buffer_.substr(0, end));
    buffer_.erase(0, end + 1);
    const std::string method = message.value("method", "");
    if (message.value("id", 0) == last_id_) {
      EXPECT_FALSE(message.contains("error")) << asked_ << "\n" << message.dump();
      answer_ = message.value("result", Json::object());
    }
    if (method == "Page.loadEventFired") loaded_ = true;
    for (const char* complaint : {"Runtime.exceptionThrown", "Log.entryAdded", "Runtime.consoleAPICalled"})
      if (method == complaint) note_complaint(message["params"].dump());
  }

  /// Drivers remark that reading pixels back takes time; the tests do that, not the page.
  void note_complaint(const std::string& text) {
    if (text.find("GL Driver Message (OpenGL, Performance") == std::string::npos) complaints_.push_back(text);
  }

  Json fail() {
    if (running_ && !closing_)
      ADD_FAILURE() << "Chromium cannot be started, ended, or did not answer " << asked_;
    running_ = false;
    return Json::object();
  }

  pid_t process_ = 0;
  int to_ = -1, from_ = -1, last_id_ = 0;
  bool running_ = true, loaded_ = false, closing_ = false;
  std::string buffer_, session_, asked_;
  Json answer_;
  std::vector<std::string> complaints_;
};

}  // namespace cupola::test
