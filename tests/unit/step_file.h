#pragma once

// STEP files as gmsh writes them, and their text.

#include "scratch_folder.h"

#include <vibrocontact/base/child_process.h>
#include <vibrocontact/scene/gmsh_library.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <string>

namespace vibrocontact
{
  /// A CAD file of this name, in mm, in the scratch folder of each rank. @param draw adds shapes to gmsh's kernel
  inline std::string step_file(const std::string &name, const std::function<void()> &draw)
  {
    const std::string file = scratch_folder() + "/" + name;
    const ChildResult result = run_in_child(
        [&]
        {
          start_gmsh();
          draw();
          gmsh::model::occ::synchronize();
          gmsh::write(file);
          return std::string("written");
        },
        60, 4e9);
    EXPECT_EQ(result.output, "written") << result.error;
    return file;
  }

  inline std::string step_text(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  /// The first @p from is @p to.
  inline std::string step_with(std::string text, const std::string &from, const std::string &to)
  {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return place == std::string::npos ? text : text.replace(place, from.size(), to);
  }
} // namespace vibrocontact
