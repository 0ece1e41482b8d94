#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/figures.h>
#include <vibrocontact/output/scene_picture.h>

#include <nlohmann/json.hpp>

#include <filesystem>

namespace vibrocontact
{
  namespace
  {
    /// Sizes of bodies that have no surface of their own [m].
    nlohmann::ordered_json sizes(const BodyParameters &body)
    {
      if (body.type == "half-space")
        return {{"radius_x_m", body.half_space.radius_x}, {"radius_y_m", body.half_space.radius_y}};
      if (body.type == "beam rail")
        return {{"length_m", body.beam_rail.length}, {"supports_m", body.beam_rail.supports()}};
      if (body.type == "bar")
        return {{"length_m", body.bar.length}};
      if (body.type == "layer")
        return {{"length_m", body.layer.length}, {"height_m", body.layer.height}};
      if (body.type == "ring")
        return {{"radius_m", body.ring.radius}};
      return nlohmann::ordered_json::object();
    }

    nlohmann::ordered_json grid_json(const ContactGrid &grid)
    {
      return {{"n_x", grid.n_x},
              {"n_y", grid.n_y},
              {"spacing_x_m", grid.spacing_x},
              {"spacing_y_m", grid.spacing_y},
              {"x_first_m", grid.x_first},
              {"y_first_m", grid.y_first}};
    }
  } // namespace

  void draw_scene(const std::vector<DrawnBody> &bodies, const ContactGrid *const grid,
                  const std::string &folder)
  {
    on_first_rank([&] { std::filesystem::create_directories(folder + "/fields"); });
    nlohmann::ordered_json scene = {{"bodies", nlohmann::ordered_json::array()}};
    for (const DrawnBody &body : bodies)
    {
      nlohmann::ordered_json one = {{"name", body.parameters->name}, {"type", body.parameters->type}};
      one.update(sizes(*body.parameters));
      if (body.solid)
      {
        const std::string set = "scene_" + body.parameters->name;
        const dealii::PETScWrappers::MPI::Vector at_rest(body.solid->locally_owned,
                                                         body.solid->communicator());
        write_surface_fields(*body.solid, {{&at_rest}}, folder, set);
        one["surface"] = field_name(set, 0);
      }
      scene["bodies"].push_back(one);
    }
    if (grid)
      scene["contact_grid"] = grid_json(*grid);
    on_first_rank([&] { write_file(folder + "/scene.json", scene.dump(2) + "\n"); });
    draw_figures(folder, "--scene");
  }
} // namespace vibrocontact
