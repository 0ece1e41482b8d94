#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/contact/body_places.h>
#include <vibrocontact/output/contact_patch.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>

namespace vibrocontact
{
  const std::vector<std::string> &contact_patch_columns()
  {
    static const std::vector<std::string> names = {
        "gap_m", "pressure_Pa", "traction_x_Pa", "traction_y_Pa", "slip_x_m_s", "slip_y_m_s", "status"};
    return names;
  }

  std::vector<double> contact_patch_values(const ContactSolution &contact, const ContactGrid &grid,
                                           const unsigned int point)
  {
    const unsigned int n = contact.R.size() / 3;
    const double area = grid.cell_area();
    return {contact.y[point],
            contact.R[point] / area,
            contact.R[n + point] / area,
            contact.R[2 * n + point] / area,
            contact.y[n + point],
            contact.y[2 * n + point],
            static_cast<double>(contact.status[point])};
  }

  std::string with_contact(const std::string &name, const PlacedContact &contact)
  {
    return contact.name.empty() ? name : name + "_" + contact.name;
  }

  void write_contact_patch(const ContactSolution &contact, const PlacedContacts &contacts,
                           const unsigned int k, const bool only_closed, const std::string &file_name)
  {
    const ContactGrid &grid = contacts.all[k].grid;
    const ContactFrame &frame = contacts.all[k].frame;
    const unsigned int first = contacts.first_point(k);
    const std::array<double, 3> place = places_of_bodies(contacts)[contacts.all[k].above];
    using Patch = dealii::DataOutBase::Patch<2, 3>;
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      if (!only_closed || contact.status[first + i] != ContactStatus::open)
        points.push_back(i);
    if (points.empty())
      points.push_back(0);
    std::vector<Patch> patches(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
    {
      const std::vector<double> values = contact_patch_values(contact, grid, first + points[p]);
      patches[p].patch_index = p;
      patches[p].reference_cell = dealii::ReferenceCells::Quadrilateral;
      patches[p].data.reinit(values.size(), 4);
      for (unsigned int v = 0; v < 4; ++v)
      {
        const double x = grid.x(points[p]) + (v % 2 ? 0.5 : -0.5) * grid.spacing_x,
                     y = grid.y(points[p]) + (v / 2 ? 0.5 : -0.5) * grid.spacing_y;
        for (unsigned int d = 0; d < 3; ++d)
          patches[p].vertices[v][d] =
              place[d] + frame.origin[d] + x * frame.axes[1][d] + y * frame.axes[2][d];
        for (unsigned int k = 0; k < values.size(); ++k)
          patches[p].data(k, v) = values[k];
      }
    }
    std::ostringstream text;
    dealii::DataOutBase::VtkFlags flags;
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    dealii::DataOutBase::write_vtu(patches, contact_patch_columns(), {}, flags, text);
    write_file(file_name, text.str());
  }
} // namespace vibrocontact
