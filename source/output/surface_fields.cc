#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/output/surface_fields.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>
#include <tuple>

namespace vibrocontact
{
  void write_surface(const std::vector<double> &points, const std::vector<int> &quads,
                     const std::vector<SurfaceField> &fields, const std::string &file_name,
                     const std::array<double, 3> &place)
  {
    using Patch = dealii::DataOutBase::Patch<2, 3>;
    std::vector<Patch> patches(quads.size() / 4);
    // deal.II counts the vertices of a quadrilateral line by line, ours run around it
    const unsigned int around[] = {0, 1, 3, 2};
    for (unsigned int p = 0; p < patches.size(); ++p)
    {
      Patch &patch = patches[p];
      patch.patch_index = p;
      patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
      patch.data.reinit(3 * fields.size(), 4);
      for (unsigned int v = 0; v < 4; ++v)
      {
        const unsigned int i = quads[4 * p + around[v]];
        for (unsigned int d = 0; d < 3; ++d)
        {
          patch.vertices[v][d] = points[3 * i + d] + place[d];
          for (unsigned int f = 0; f < fields.size(); ++f)
            patch.data(3 * f + d, v) = fields[f].second[3 * i + d];
        }
      }
    }
    std::vector<std::string> names;
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
        vectors;
    for (const SurfaceField &field : fields)
    {
      vectors.emplace_back(names.size(), names.size() + 2, field.first,
                           dealii::DataComponentInterpretation::component_is_part_of_vector);
      names.insert(names.end(), 3, field.first);
    }
    dealii::DataOutBase::VtkFlags flags;
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    std::ostringstream text;
    dealii::DataOutBase::write_vtu(patches, names, vectors, flags, text);
    write_file(file_name, text.str());
  }

  void write_pvd(const std::vector<std::pair<double, std::string>> &files, const std::string &file_name)
  {
    std::ostringstream text;
    dealii::DataOutBase::write_pvd_record(text, files);
    write_file(file_name, text.str());
  }
} // namespace vibrocontact
