#pragma once

#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/reduction/flow_reduction.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/reduction/response_reduction.h>
#include <vibrocontact/reduction/revolved_shapes.h>
#include <vibrocontact/reduction/surface_shapes.h>
#include <vibrocontact/waveguide/track_reduction.h>

#include <deal.II/base/mpi.h>

#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace vibrocontact
{
  /// What the parts of a reduction are made of, by name, and what can be done with each: written to a file,
  /// read back, sent from rank 0 to all. Only ReductionCache uses it.
  namespace reduction_archive
  {
    inline std::string joined(const std::vector<std::string> &texts)
    {
      std::string result;
      for (const auto &text : texts)
        result += text + '\n';
      return result;
    }

    inline std::vector<std::string> split(const std::string &text)
    {
      std::vector<std::string> result;
      std::istringstream stream(text);
      for (std::string line; std::getline(stream, line);)
        result.push_back(line);
      return result;
    }

    // What a part is made of, named once for saving, loading and replicating; the checksum depends on the
    // order.
    template <typename Archive, typename Part>
    void visit_static(Archive &archive, Part &part)
    {
      archive("name", part.name);
      archive("grid/n_x", part.grid.n_x);
      archive("grid/n_y", part.grid.n_y);
      archive("grid/spacing_x_m", part.grid.spacing_x);
      archive("grid/spacing_y_m", part.grid.spacing_y);
      archive("grid/x_first_m", part.grid.x_first);
      archive("grid/y_first_m", part.grid.y_first);
      archive("grid/traction", part.grid.traction);
      archive("n_dofs", part.n_dofs);
      archive("compliance_m_N", part.compliance);
      archive("load_response_m", part.load_response);
      archive("lifting", part.lifting);
      archive("surface_height_m", part.surface_height);
      archive("rigid_trace", part.rigid_trace);
      archive("rigid_load", part.rigid_load);
    }

    template <typename Archive, typename Part>
    void visit_modal(Archive &archive, Part &part)
    {
      archive("n_rigid_modes", part.n_rigid_modes);
      archive("n_dofs", part.n_dofs);
      archive("orthonormality_error", part.orthonormality_error);
      archive("residual", part.residual);
      archive("seconds", part.seconds);
      archive("omega_rad_s", part.omega);
      archive("damping_ratio", part.damping_ratio);
      archive("labels", part.labels);
      archive("loss_1_s2", part.loss);
      archive("damping_coupling", part.damping_coupling);
      archive("trace", part.trace);
      archive("load", part.load);
      archive("participation", part.participation);
    }

    template <typename Archive, typename Part>
    void visit_shapes(Archive &archive, Part &part)
    {
      archive("points_m", part.points);
      archive("quads", part.quads);
      archive("omega_rad_s", part.omega);
      archive("shapes", part.shapes);
    }

    template <typename Archive, typename Part>
    void visit_section(Archive &archive, Part &part)
    {
      archive("omega_rad_s", part.omega);
      archive("waves", part.waves);
      archive("odd", part.odd);
      archive("points_m", part.points);
      archive("shapes", part.shapes);
      archive("cells", part.cells);
      archive("first", part.first);
      archive("second", part.second);
      archive("energies_1_s2", part.energies);
      archive("hub", part.hub);
    }

    template <typename Archive, typename Part>
    void visit_flow(Archive &archive, Part &part)
    {
      archive("angular_frequencies_rad_s", part.omega);
      archive("fixed", part.fixed);
      archive("turning", part.turning);
      archive("of_square", part.of_square);
      archive("names", part.names);
      archive("stretch", part.stretch);
      archive("beyond", part.beyond);
      archive("beyond_compliance_m_N", part.beyond_compliance);
    }

    template <typename Archive, typename Part>
    void visit_response(Archive &archive, Part &part)
    {
      archive("n_dofs", part.n_dofs);
      archive("n_rigid_modes", part.n_rigid_modes);
      archive("seconds", part.seconds);
      archive("omega_rad_s", part.omega);
      archive("damping_ratio", part.damping_ratio);
      archive("loss_1_s2", part.loss);
      archive("damping_1_s", part.damping);
      archive("gyroscopic", part.gyroscopic);
      archive("trace", part.trace);
      archive("compliance_m_N", part.compliance);
    }

    template <typename Archive, typename Part>
    void visit_direct(Archive &archive, Part &part)
    {
      archive("seconds", part.seconds);
      archive("frequency_Hz", part.frequency);
      archive("real_m_N", part.real);
      archive("imaginary_m_N", part.imaginary);
    }

    template <typename Archive, typename Part>
    void visit_track(Archive &archive, Part &part)
    {
      archive("n_dofs", part.n_dofs);
      archive("section/shapes", part.section.shapes);
      archive("section/axial", part.section.axial);
      archive("section/shares", part.section.shares);
      archive("section/dofs", part.section.dofs);
      archive("radius_m", part.radius);
      archive("bed_m_N", part.bed);
      archive("motions", part.motions);
      archive("at_rest_m_N", part.at_rest);
      archive("at_once_m_N", part.at_once);
      archive("on_bed_m_N", part.on_bed);
      archive("surface_height_m", part.surface_height);
      archive("frequency_Hz", part.frequency);
      archive("real_m_N", part.real);
      archive("imaginary_m_N", part.imaginary);
      archive("seconds", part.seconds);
    }

    template <typename Archive, typename Part>
    void visit(Archive &archive, Part &part)
    {
      using Kind = std::remove_const_t<Part>;
      if constexpr (std::is_same_v<Kind, StaticReduction>)
        visit_static(archive, part);
      else if constexpr (std::is_same_v<Kind, SurfaceShapes>)
        visit_shapes(archive, part);
      else if constexpr (std::is_same_v<Kind, RevolvedShapes>)
        visit_section(archive, part);
      else if constexpr (std::is_same_v<Kind, FlowReduction>)
        visit_flow(archive, part);
      else if constexpr (std::is_same_v<Kind, ResponseReduction>)
        visit_response(archive, part);
      else if constexpr (std::is_same_v<Kind, DirectResponse>)
        visit_direct(archive, part);
      else if constexpr (std::is_same_v<Kind, TrackReduction>)
        visit_track(archive, part);
      else if constexpr (std::is_same_v<Kind, DenseMatrix>)
        archive("attachment_mass", part);
      else
        visit_modal(archive, part);
    }

    class Save
    {
    public:
      explicit Save(Hdf5Writer &file) : file(file) {}
      template <typename T>
      void operator()(const std::string &name, const T &value) const
      {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
          file.write(name, static_cast<double>(value));
        else if constexpr (std::is_same_v<T, std::vector<std::string>>)
          file.write(name, joined(value));
        else if constexpr (std::is_same_v<T, std::vector<bool>>)
          file.write(name, std::vector<double>(value.begin(), value.end()));
        else if constexpr (std::is_same_v<T, std::vector<float>>)
          file.write(name, std::vector<double>(value.begin(), value.end()), {true, true});
        else
          file.write(name, value);
      }

    private:
      Hdf5Writer &file;
    };

    class Load
    {
    public:
      explicit Load(Hdf5Reader &file) : file(file) {}
      template <typename T>
      void operator()(const std::string &name, T &value) const
      {
        if constexpr (std::is_enum_v<T>)
          value = static_cast<T>(number_as<unsigned char>(file.number(name)));
        else if constexpr (std::is_arithmetic_v<T>)
          value = number_as<T>(file.number(name));
        else if constexpr (std::is_same_v<T, std::string>)
          value = file.text(name);
        else if constexpr (std::is_same_v<T, std::vector<std::string>>)
          value = split(file.text(name));
        else if constexpr (std::is_same_v<T, DenseMatrix>)
          value = file.matrix(name);
        else if constexpr (std::is_same_v<T, std::vector<int>>)
          value = file.integers(name);
        else
        {
          const std::vector<double> numbers = file.numbers(name);
          value.assign(numbers.begin(), numbers.end());
        }
      }

    private:
      Hdf5Reader &file;
    };

    /// From rank 0 to all.
    class Broadcast
    {
    public:
      explicit Broadcast(MPI_Comm communicator) : communicator(communicator) {}
      template <typename T>
      void operator()(const std::string &, T &value) const
      {
        all(value);
      }

    private:
      template <typename Number>
      std::enable_if_t<std::is_arithmetic_v<Number> || std::is_enum_v<Number>> all(Number &value) const
      {
        MPI_Bcast(&value, sizeof(Number), MPI_BYTE, 0, communicator);
      }
      void all(std::string &text) const
      {
        unsigned long long size = text.size();
        all(size);
        text.resize(size);
        MPI_Bcast(text.data(), size, MPI_CHAR, 0, communicator);
      }
      template <typename Number>
      std::enable_if_t<std::is_arithmetic_v<Number>> all(std::vector<Number> &values) const
      {
        unsigned long long size = values.size();
        all(size);
        values.resize(size);
        MPI_Bcast(values.data(), size, dealii::Utilities::MPI::mpi_type_id_for_type<Number>, 0, communicator);
      }
      void all(std::vector<bool> &flags) const
      {
        std::vector<int> values(flags.begin(), flags.end());
        all(values);
        flags.assign(values.begin(), values.end());
      }
      void all(std::vector<std::string> &texts) const
      {
        std::string text = joined(texts);
        all(text);
        texts = split(text);
      }
      void all(DenseMatrix &matrix) const
      {
        unsigned int m = matrix.m(), n = matrix.n();
        all(m);
        all(n);
        if (matrix.m() != m || matrix.n() != n)
          matrix.reinit(m, n);
        for (unsigned int j = 0; j < n && m > 0; ++j)
          MPI_Bcast(&matrix(0, j), m, MPI_DOUBLE, 0, communicator);
      }

      MPI_Comm communicator;
    };
  } // namespace reduction_archive
} // namespace vibrocontact
