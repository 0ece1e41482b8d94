#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/figures.h>
#include <vibrocontact/output/scene_picture.h>
#include <vibrocontact/output/surface_fields.h>

#include <nlohmann/json.hpp>

#include <filesystem>

namespace vibrocontact
{
  namespace
  {
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

  void draw_scene(const std::vector<DrawnBody> &bodies, const PlacedContacts *const contacts,
                  const std::string &folder)
  {
    on_first_rank([&] { std::filesystem::create_directories(folder + "/fields"); });
    nlohmann::ordered_json scene = {{"bodies", nlohmann::ordered_json::array()}};
    for (const DrawnBody &body : bodies)
    {
      nlohmann::ordered_json one = {{"name", body.parameters->name}, {"type", body.parameters->type}};
      one.update(body.parameters->description->sizes());
      if (body.solid)
      {
        const std::string set = "scene_" + body.parameters->name;
        const dealii::PETScWrappers::MPI::Vector at_rest(body.solid->locally_owned,
                                                         body.solid->communicator());
        write_surface_fields(*body.solid, {{&at_rest}}, folder, set, body.place);
        one["surface"] = field_name(set, 0);
      }
      if (!body.quads.empty())
      {
        one["surface"] = field_name("scene_" + body.parameters->name, 0);
        on_first_rank(
            [&]
            {
              write_surface(body.points, body.quads, {}, folder + "/" + one["surface"].get<std::string>(),
                            body.place);
            });
      }
      scene["bodies"].push_back(one);
    }
    for (unsigned int k = 0; contacts && k < contacts->all.size(); ++k)
    {
      const PlacedContact &contact = contacts->all[k];
      nlohmann::ordered_json one = {{"name", contact.name}, {"grid", grid_json(contact.grid)}};
      for (unsigned int d = 0; d < 3; ++d)
        one["place_m"].push_back(bodies.at(contact.above).place[d] + contact.frame.origin[d]);
      scene["contacts"].push_back(one);
    }
    on_first_rank([&] { write_file(folder + "/scene.json", scene.dump(2) + "\n"); });
    draw_figures(folder, "--scene");
  }
} // namespace vibrocontact
