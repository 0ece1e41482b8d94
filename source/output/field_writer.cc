#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/surface_fields.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_out_faces.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <cmath>
#include <sstream>

namespace boost::serialization
{
  /// What deal.II leaves out: a patch on its way to another rank.
  template <typename Archive, int dim, int spacedim>
  void serialize(Archive &archive, dealii::DataOutBase::Patch<dim, spacedim> &patch, const unsigned int)
  {
    archive &patch.vertices &patch.neighbors &patch.patch_index &patch.n_subdivisions &patch.data &patch
        .points_are_available &patch.reference_cell;
  }
} // namespace boost::serialization

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Displacement and von Mises stress; 2d: plane strain.
    template <int dim>
    class Stress : public DataPostprocessor<dim>
    {
    public:
      explicit Stress(const ElasticModel<dim> &model) : model(model) {}

      std::vector<std::string> get_names() const override
      {
        std::vector<std::string> names(dim, "displacement_m");
        names.emplace_back("von_mises_Pa");
        return names;
      }

      std::vector<DataComponentInterpretation::DataComponentInterpretation>
      get_data_component_interpretation() const override
      {
        using namespace DataComponentInterpretation;
        std::vector<DataComponentInterpretation::DataComponentInterpretation> kinds(
            dim, component_is_part_of_vector);
        kinds.push_back(component_is_scalar);
        return kinds;
      }

      UpdateFlags get_needed_update_flags() const override { return update_values | update_gradients; }

      void evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                                 std::vector<Vector<double>> &computed) const override
      {
        const ElasticMaterial &material = model.material_of(inputs.template get_cell<dim>()->material_id());
        const SymmetricTensor<4, 3> stiffness = material.stiffness();
        for (unsigned int q = 0; q < computed.size(); ++q)
        {
          SymmetricTensor<2, 3> strain;
          for (unsigned int i = 0; i < dim; ++i)
          {
            computed[q](i) = inputs.solution_values[q](i);
            for (unsigned int j = 0; j <= i; ++j)
              strain[i][j] = (inputs.solution_gradients[q][i][j] + inputs.solution_gradients[q][j][i]) / 2;
          }
          computed[q](dim) = std::sqrt(1.5) * deviator(stiffness * strain).norm();
        }
      }

    private:
      const ElasticModel<dim> &model;
    };

    DataOutBase::VtkFlags flags()
    {
      DataOutBase::VtkFlags result;
      result.compression_level = DataOutBase::VtkFlags::best_speed;
      return result;
    }

    template <int dim, int spacedim>
    void shift(DataOutBase::Patch<dim, spacedim> &patch, const std::array<double, 3> &by)
    {
      for (const unsigned int v : patch.reference_cell.vertex_indices())
        for (unsigned int d = 0; d < spacedim; ++d)
          patch.vertices[v][d] += by[d];
      // curved ones have the places of all points behind their data
      for (unsigned int d = 0; d < spacedim && patch.points_are_available; ++d)
        for (unsigned int i = 0; i < patch.data.n_cols(); ++i)
          patch.data(patch.data.n_rows() - spacedim + d, i) += by[d];
    }

    /// Output whose ranks give their patches to rank 0, which writes them as one piece, whole or not at all: with
    /// MPI input-output a full disk may meet some ranks only, and many readers take the first piece for all.
    template <typename Output>
    class Gathered : public Output
    {
    public:
      using Output::Output;

      /// @param place added to every point [m]
      void write(const std::string &file, const std::array<double, 3> &place,
                 const MPI_Comm communicator) const
      {
        const auto gathered = Utilities::MPI::gather(communicator, this->get_patches());
        on_first_rank(
            [&]
            {
              auto patches = gathered.front();
              for (std::size_t rank = 1; rank < gathered.size(); ++rank)
                patches.insert(patches.end(), gathered[rank].begin(), gathered[rank].end());
              for (auto &patch : patches)
                shift(patch, place);
              std::ostringstream text;
              DataOutBase::write_vtu(patches, this->get_dataset_names(), this->get_nonscalar_data_ranges(),
                                     flags(), text);
              write_file(file, text.str());
            },
            communicator);
      }
    };

    /// The displacement on the faces of tetrahedra and prisms, whose middles deal.II's DataOutFaces leaves out or does
    /// not know: triangles and quadrilaterals between the nodes, triangles as quadrilaterals with one corner twice.
    class FaceOutput : public DataOutInterface<2, 3>
    {
    public:
      FaceOutput() = default;

      void build_patches(const ElasticBody<3> &body, const PETScWrappers::MPI::Vector &displacement)
      {
        using Corners = std::array<unsigned int, 4>;
        const ReferenceCell shape = body.element.reference_cell();
        const unsigned int n = body.element.degree;
        std::vector<std::unique_ptr<FEValues<3>>> values;
        std::vector<std::vector<Corners>> pieces;
        for (unsigned int f = 0; f < shape.n_faces(); ++f)
        {
          // the points (i, j) / n of the face; of a triangle those with i + j <= n
          const bool triangle = shape.face_reference_cell(f) == ReferenceCells::Triangle;
          std::vector<Point<3>> points;
          std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
          for (unsigned int j = 0; j <= n; ++j)
            for (unsigned int i = 0; i <= (triangle ? n - j : n); ++i)
            {
              number[{i, j}] = points.size();
              points.push_back(on_face<3>(shape, f, Point<2>(double(i) / n, double(j) / n)));
            }
          pieces.emplace_back();
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < (triangle ? n - j : n); ++i)
            {
              const unsigned int a = number[{i, j}], b = number[{i + 1, j}], c = number[{i, j + 1}];
              if (!triangle)
                pieces.back().push_back({{a, b, c, number[{i + 1, j + 1}]}});
              else
              {
                pieces.back().push_back({{a, b, c, c}});
                if (i + j + 1 < n)
                  pieces.back().push_back({{b, number[{i + 1, j + 1}], c, c}});
              }
            }
          values.push_back(std::make_unique<FEValues<3>>(body.mapping, body.element, Quadrature<3>(points),
                                                         update_values | update_quadrature_points));
        }
        std::vector<Vector<double>> u;
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned() && cell->at_boundary())
            for (const unsigned int f : cell->face_indices())
            {
              if (!cell->face(f)->at_boundary())
                continue;
              values[f]->reinit(cell);
              u.assign(values[f]->n_quadrature_points, Vector<double>(3));
              values[f]->get_function_values(displacement, u);
              for (const Corners &corners : pieces[f])
              {
                DataOutBase::Patch<2, 3> patch;
                patch.patch_index = patches.size();
                patch.reference_cell = ReferenceCells::Quadrilateral;
                patch.data.reinit(3, 4);
                for (unsigned int v = 0; v < 4; ++v)
                {
                  patch.vertices[v] = values[f]->quadrature_point(corners[v]);
                  for (unsigned int d = 0; d < 3; ++d)
                    patch.data(d, v) = u[corners[v]][d];
                }
                patches.push_back(patch);
              }
            }
      }

    protected:
      const std::vector<DataOutBase::Patch<2, 3>> &get_patches() const override { return patches; }
      std::vector<std::string> get_dataset_names() const override
      {
        return std::vector<std::string>(3, "displacement");
      }
      std::vector<std::tuple<unsigned int, unsigned int, std::string,
                             DataComponentInterpretation::DataComponentInterpretation>>
      get_nonscalar_data_ranges() const override
      {
        return {{0, 2, "displacement", DataComponentInterpretation::component_is_part_of_vector}};
      }

    private:
      std::vector<DataOutBase::Patch<2, 3>> patches;
    };

    /// The displacement with a rigid vertical one added, held nodes included; ghosted like the original.
    template <int dim>
    PETScWrappers::MPI::Vector lifted(const ElasticBody<dim> &body,
                                      const PETScWrappers::MPI::Vector &displacement, const double vertical)
    {
      PETScWrappers::MPI::Vector owned(body.locally_owned, body.communicator());
      owned = displacement;
      ComponentMask is_vertical(dim, false);
      is_vertical.set(dim - 1, true);
      for (const auto dof : DoFTools::extract_dofs(body.dof_handler, is_vertical) & body.locally_owned)
        owned(dof) += vertical;
      owned.compress(VectorOperation::add);
      PETScWrappers::MPI::Vector result(body.locally_owned, body.locally_relevant, body.communicator());
      result = owned;
      return result;
    }

    template <int dim, typename WriteState>
    void write_set(const ElasticBody<dim> &body, const std::vector<FieldState> &states,
                   const std::string &folder, const std::string &set, const WriteState &write_state)
    {
      std::vector<std::pair<double, std::string>> record;
      for (unsigned int k = 0; k < states.size(); ++k)
      {
        const std::string name = field_name(set, k);
        PETScWrappers::MPI::Vector displacement = body.complete(*states[k].displacement);
        if (states[k].vertical != 0)
          displacement = lifted(body, displacement, states[k].vertical);
        write_state(displacement, folder + "/" + name);
        record.emplace_back(states[k].time, name);
      }
      on_first_rank([&] { write_pvd(record, folder + "/" + set + ".pvd"); }, body.communicator());
    }
  } // namespace

  std::string field_name(const std::string &set, const unsigned int k)
  {
    return "fields/" + set + "_" + Utilities::int_to_string(k, 4) + ".vtu";
  }

  template <int dim>
  void write_fields(const ElasticBody<dim> &body, const std::vector<FieldState> &states,
                    const std::string &folder, const std::string &set, const std::array<double, 3> &place)
  {
    const auto write_state = [&](const PETScWrappers::MPI::Vector &displacement, const std::string &file)
    {
      const Stress<dim> stress(body.model);
      Gathered<DataOut<dim>> output;
      output.add_data_vector(body.dof_handler, displacement, stress);
      // deal.II 9.4 divides no prisms: they are drawn by their corners
      const bool divides = body.mesh.reference_cell() != ReferenceCells::Wedge;
      output.build_patches(body.mapping, divides ? body.element.degree : 1, DataOut<dim>::curved_boundary);
      output.write(file, place, body.communicator());
    };
    write_set(body, states, folder, set, write_state);
  }

  template <int dim>
  void write_surface_fields(const ElasticBody<dim> &body, const std::vector<FieldState> &states,
                            const std::string &folder, const std::string &set,
                            const std::array<double, 3> &place)
  {
    const auto write_state = [&](const PETScWrappers::MPI::Vector &displacement, const std::string &file)
    {
      if constexpr (dim == 3)
        if (!body.mesh.is_hypercube())
        {
          Gathered<FaceOutput> output;
          output.build_patches(body, displacement);
          output.write(file, place, body.communicator());
          return;
        }
      Gathered<DataOutFaces<dim>> output(true);
      output.add_data_vector(body.dof_handler, displacement, std::vector<std::string>(dim, "displacement"),
                             std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                                 dim, DataComponentInterpretation::component_is_part_of_vector));
      output.build_patches(body.mapping, body.element.degree);
      output.write(file, place, body.communicator());
    };
    write_set(body, states, folder, set, write_state);
  }

  template void write_fields(const ElasticBody<2> &, const std::vector<FieldState> &, const std::string &,
                             const std::string &, const std::array<double, 3> &);
  template void write_fields(const ElasticBody<3> &, const std::vector<FieldState> &, const std::string &,
                             const std::string &, const std::array<double, 3> &);
  template void write_surface_fields(const ElasticBody<2> &, const std::vector<FieldState> &,
                                     const std::string &, const std::string &, const std::array<double, 3> &);
  template void write_surface_fields(const ElasticBody<3> &, const std::vector<FieldState> &,
                                     const std::string &, const std::string &, const std::array<double, 3> &);
} // namespace vibrocontact
