// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/child_process.h"

#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "io/mesh/soup_bytes.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;
using io::run_in_child;

TEST_CASE("run_in_child: the answer comes back whole") {
  std::string megabytes(3'000'000, 'x');
  megabytes[1'234'567] = '\0';
  CHECK(run_in_child([&] { return megabytes; }) == megabytes);
  CHECK(run_in_child([] { return std::string(); }).empty());
}

TEST_CASE("run_in_child: what happens in the child is a content error here") {
  const auto error = [](const std::function<std::string()>& work, const io::ChildLimits& limits = {}) {
    return content_error([&] { run_in_child(work, limits); });
  };
  CHECK(error([]() -> std::string { throw std::runtime_error("bad file"); }) == "bad file");
  CHECK(error([]() -> std::string { throw 7; }) == "unknown error");
  CHECK(error([]() -> std::string { ::raise(SIGSEGV), ::_exit(9); }).find("crashed (signal 11)") !=
        std::string::npos);
  CHECK(error([]() -> std::string { ::abort(); }).find("crashed (signal 6)") != std::string::npos);
  CHECK(error([]() -> std::string { ::_exit(9); }).find("status 9") != std::string::npos);
  const auto spin = []() -> std::string {
    volatile bool forever = true;
    while (forever) continue;
    return {};
  };
  CHECK(error(spin, {.cpu_seconds = 1}).find("CPU time") != std::string::npos);
  const auto sleep = [] { return ::pause(), std::string(); };
  CHECK(error(sleep, {.seconds = 1}).find("more than 1 s") != std::string::npos);
  CHECK(error([] { return std::string(5000, 'x'); }, {.answer_bytes = 4000}).find("larger than") !=
        std::string::npos);
  CHECK_THROWS_AS(run_in_child([] { return std::string(); }, {.seconds = 0}), std::invalid_argument);
}

#ifndef FURROW_SANITIZED
TEST_CASE("run_in_child: memory is limited") {
  const auto devour = [] { return std::string(std::size_t{1} << 29, 'x'); };
  CHECK(content_error([&] {
          run_in_child(devour, {.memory_bytes = std::size_t{1} << 27});
        }).find("too much memory") != std::string::npos);
}
#endif

TEST_CASE("soup_bytes: a soup comes back, damaged bytes are refused") {
  io::SoupFile file;
  file.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1.0 / 3, 0}};
  file.soup.corners = {0, 1, 2};
  file.soup.close_face();
  file.soup.textures.assign(3, {0.5, 0.25});
  file.soup.groups = {1};
  file.group_names = {"a", "long name"};
  file.merged_vertices = 4;
  const std::string bytes = io::to_bytes(file);
  const io::SoupFile back = io::soup_from_bytes(bytes);
  CHECK(back.soup.points == file.soup.points);
  CHECK(back.soup.corners == file.soup.corners);
  CHECK(back.soup.textures == file.soup.textures);
  CHECK(back.group_names == file.group_names);
  CHECK(back.merged_vertices == 4);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS(io::soup_from_bytes(bytes.substr(0, size)), geometry::ContentError);
  CHECK_THROWS_AS(io::soup_from_bytes(bytes + "x"), geometry::ContentError);
  file.soup.corners[2] = 3;
  CHECK_THROWS_AS(io::soup_from_bytes(io::to_bytes(file)), geometry::ContentError);
  file.soup.corners[2] = 2;
  file.soup.groups = {1, 2};
  CHECK_THROWS_AS(io::soup_from_bytes(io::to_bytes(file)), geometry::ContentError);
}
