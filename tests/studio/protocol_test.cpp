// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "studio/replay.h"
#include "studio/session.h"
#include "tests/studio/visitor.h"

namespace furrow {
namespace {

using jobs::Json;
using tests::Desk;

/// What a page would hear and see.
struct Ear : studio::Outbox {
  void tell(studio::Client, const Json& message) override {
    if (message.contains("status")) status = message["status"];
    if (message.contains("id")) answer = message;
  }
  void show(studio::Client, studio::Bytes frame) override {
    if (frame->at(4) == 0) cloth = *frame;
  }
  Json status, answer;
  std::string cloth;
};

/// A session without a server, what it says, and what its history should be.
class Play {
 public:
  explicit Play(const Desk& desk) : session_(desk.scene, desk.project(), ear_) {
    drawings_.push_back(drawing());
    start_ = session_.shape_bits();
    session_.greet(1);
  }

  Json ask(const Json& body) {
    const Json before = drawing();
    const std::string cloth = ear_.cloth;
    ear_.answer = nullptr;
    session_.allow();
    session_.handle(1, {"x", body.value("do", ""), body});
    RC_ASSERT(ear_.answer.is_object());
    RC_ASSERT(ear_.answer.at("id") == "x");
    check(body, before, cloth);
    return ear_.answer;
  }

  void undo_all() {
    while (at_ > 0) RC_ASSERT(ask({{"do", "undo"}}).contains("done"));
    RC_ASSERT(drawing() == drawings_[0]);
    RC_ASSERT(session_.shape_bits() == start_);
  }
  void redo_all() {
    while (at_ + 1 < drawings_.size()) RC_ASSERT(ask({{"do", "redo"}}).contains("done"));
  }
  std::size_t lines() const { return drawing().at("lines").size(); }

 private:
  Json drawing() const { return session_.project().now().drawing; }

  /// The model: a list of drawings, and a place in it.
  void check(const Json& body, const Json& before, const std::string& cloth) {
    const std::string what = body.value("do", "");
    const bool done = ear_.answer.contains("done");
    if (!done) {
      RC_ASSERT(ear_.answer.at("refused").get<std::string>().size() > 5);
      RC_ASSERT(drawing() == before);
      RC_ASSERT(ear_.cloth == cloth);
    } else if (what == "undo") {
      --at_;
    } else if (what == "redo") {
      ++at_;
    } else if (session_.project().at() != at_) {
      RC_ASSERT(session_.project().at() == at_ + 1);
      drawings_.resize(++at_);
      drawings_.push_back(drawing());
    }
    RC_ASSERT(session_.project().at() == at_);
    RC_ASSERT(session_.project().count() == drawings_.size());
    RC_ASSERT(drawing() == drawings_[at_]);
    RC_ASSERT(ear_.status.at("step") == at_);
    RC_ASSERT(ear_.status.at("lines").size() == drawing().at("lines").size());
    RC_ASSERT(ear_.status.at("undo").get<std::string>().empty() == (at_ == 0));
  }

  Ear ear_;
  studio::Session session_;
  std::vector<Json> drawings_;
  std::size_t at_ = 0;
  std::string start_;
};

/// Something that a page might ask, mostly what can be done.
Json any_intention(std::mt19937_64& random, std::size_t lines) {
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  const auto in = [&](double low, double high) { return low + (high - low) * share(); };
  const auto one = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::size_t line = one(lines + (share() < 0.1 ? 2 : 0));
  const double x = in(-0.16, 0.16);
  const Json points{{x, in(0.05, 0.12), 0.0}, {x + in(-0.03, 0.03), 0.2, 0.0}, {x, in(0.25, 0.33), 0.0}};
  const std::vector<std::function<Json()>> all{
      [&] {
        return Json{
            {"do", "draw"}, {"height", in(-0.02, 0.02)}, {"width", in(0.03, 0.1)}, {"points", points}};
      },
      [&] {
        return Json{{"do", "draw"}, {"height", in(0, 0.02)}, {"mirror", share() < 0.5}, {"points", points}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"height", in(-0.03, 0.03)}, {"live", share() < 0.3}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"on", share() < 0.5}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"sharpness", in(-0.1, 1.1)}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"width", share() < 0.3 ? Json() : Json(in(0, 0.2))}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"press", in(0.5, 100)}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"points", points}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"name", "n" + std::to_string(one(5))}};
      },
      [&] {
        return Json{{"do", "delete"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "duplicate"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "mirror"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "move"}, {"line", line}, {"to", one(lines)}};
      },
      [&] {
        return Json{{"do", "middle"}, {"x", in(-0.1, 0.1)}};
      },
      [&] {
        return Json{{"do", "pin"}, {"at", {in(-0.2, 0.2), in(0, 0.4), 0.0}}};
      },
      [&] {
        return Json{{"do", "hold"}, {"border", 0}, {"on", share() < 0.5}};
      },
      [&] {
        return Json{{"do", "wind"}, {"velocity", {in(-5, 5), 0.0, in(-5, 5)}}};
      },
      [&] {
        return Json{{"do", "fabric"}, {"name", share() < 0.5 ? "denim" : "silk"}};
      },
      [&] {
        return Json{{"do", share() < 0.7 ? "undo" : "redo"}};
      },
      [&] {
        return Json{{"do", share() < 0.7 ? "undo" : "redo"}};
      },
      [&] {
        return Json{{"do", share() < 0.3 ? "save" : "tangles"}};
      },
      [&] {
        return Json{{"do", "points"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "fit"}, {"by", "strain"}};
      },
      [&] {
        if (share() > 0.3) return Json{{"do", "undo"}};
        return Json{{"do", "play"}, {"seconds", 1 / 60.0}};
      }};
  return all[one(all.size())]();
}

/// Asks for so much, undoes it all, does it all again, and, if so wanted, replays the log.
void do_at_random(std::uint64_t seed, int intentions, const std::string& name, bool replays = true) {
  const Desk desk(name);
  std::mt19937_64 random(seed);
  {
    Play play(desk);
    for (int i = 0; i < intentions; ++i) play.ask(any_intention(random, play.lines()));
    play.undo_all();
    play.redo_all();
  }
  if (!replays) return;
  const auto report = studio::replay(desk.project(), desk.folder / "again", [](auto, auto) { return true; });
  RC_ASSERT(report.difference == "");
}

}  // namespace

TEST_CASE(
    "studio protocol: random intentions are done or refused, undone to the start, and replayed to its bits",
    "[long]") {
  int runs = 0;  // each takes half a second: the first twenty of the cases that are asked for
  CHECK(rc::check([&runs] {
    if (runs++ < 20) do_at_random(*rc::gen::arbitrary<std::uint64_t>(), 12, "random");
  }));
}

TEST_CASE("studio protocol: a thousand random intentions are, too", "[release]") {
  std::mt19937_64 seeds(22);
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t seed = seeds();
    INFO(seed);
    CHECK_NOTHROW(do_at_random(seed, 50, "thousand", i % 5 == 0));
  }
}

}  // namespace furrow
