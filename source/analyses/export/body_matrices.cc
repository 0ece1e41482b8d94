#include <vibrocontact/analyses/export/body_matrices.h>
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/label_text.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/matrices/matrix_market.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// roots of W~ below this share of the compliance are rounding
    constexpr double least_flexibility = 1e-15;

    /// Columns sqrt(l) x of W~ = sum of l x x^T.
    DenseMatrix roots_of(const DenseMatrix &W, const double whole)
    {
      const unsigned int n = W.m();
      DenseMatrix copy = W;
      copy.set_property(dealii::LAPACKSupport::symmetric);
      DenseVector roots;
      dealii::FullMatrix<double> vectors;
      if (n > 0 && whole > 0)
        copy.compute_eigenvalues_symmetric(least_flexibility * whole, 1e300, 0., roots, vectors);
      DenseMatrix result(n, roots.size());
      for (unsigned int k = 0; k < roots.size(); ++k)
        for (unsigned int i = 0; i < n; ++i)
          result(i, k) = std::sqrt(roots[k]) * vectors(i, k);
      return result;
    }

    std::string comment(const BodyMatrices &body, const std::string &what)
    {
      return what + " of the reduced body " + body.name + ": " + std::to_string(body.n_modes) + " modes (" +
             std::to_string(body.n_rigid_modes) + " rigid), then " +
             std::to_string(body.mass.m() - body.n_modes) + " coordinates of residual flexibility; SI";
    }
  } // namespace

  BodyMatrices body_matrices(const ReducedBody &body)
  {
    BodyMatrices result;
    result.name = body.name;
    result.n_modes = body.n_modes();
    result.n_rigid_modes = body.n_rigid_modes;
    result.omega = body.omega;
    result.damping_ratio = body.damping_ratio;
    result.labels = body.labels;
    const unsigned int n_points = body.grid.n_points(), n_rows = 3 * n_points, m = body.n_modes();
    result.residual = body.residual;
    double whole = 0;
    for (unsigned int i = 0; i < n_rows; ++i)
    {
      double compliance = body.residual(i, i);
      for (unsigned int k = body.n_rigid_modes; k < m; ++k)
        compliance += body.trace(i, k) * body.trace(i, k) / (body.omega[k] * body.omega[k]);
      whole = std::max(whole, compliance);
    }
    const DenseMatrix rest = roots_of(body.residual, whole);
    const unsigned int n = m + rest.n();
    result.mass.reinit(n, n);
    result.stiffness.reinit(n, n);
    result.recovery.reinit(n_rows, n);
    for (unsigned int k = 0; k < n; ++k)
    {
      result.mass(k, k) = k < m ? 1 : 0;
      result.stiffness(k, k) = k < m ? body.omega[k] * body.omega[k] : 1;
      for (unsigned int i = 0; i < n_rows; ++i)
        result.recovery(i, k) = k < m ? body.trace(i, k) : rest(i, k - m);
    }
    if (body.loss.m() > 0)
    {
      result.structural_damping.reinit(n, n);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          result.structural_damping(i, j) = body.loss(i, j);
    }
    else
    {
      result.damping.reinit(n, n);
      for (unsigned int k = 0; k < m; ++k)
        result.damping(k, k) = 2 * body.damping_ratio[k] * body.omega[k];
    }
    result.translations.reinit(n, 3);
    if (body.participation.m() == m)
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          result.translations(k, d) = body.participation(k, d);
    for (unsigned int i = 0; i < n_points; ++i)
      result.points.emplace_back(body.grid.x(i), body.grid.y(i), body.surface_height.at(i));
    return result;
  }

  StateSpace state_space(const BodyMatrices &body)
  {
    const unsigned int m = body.n_modes, n_rows = body.recovery.m();
    StateSpace space;
    space.A.reinit(2 * m, 2 * m);
    space.B.reinit(2 * m, n_rows);
    space.C.reinit(n_rows, 2 * m);
    space.D = body.residual;
    for (unsigned int k = 0; k < m; ++k)
    {
      space.A(k, m + k) = 1;
      space.A(m + k, k) = -body.omega[k] * body.omega[k];
      space.A(m + k, m + k) = -2 * body.damping_ratio[k] * body.omega[k];
      for (unsigned int i = 0; i < n_rows; ++i)
        space.C(i, k) = space.B(m + k, i) = body.recovery(i, k);
    }
    return space;
  }

  void write_matrices(const BodyMatrices &body, const std::string &folder)
  {
    const auto write = [&](const std::string &name, const DenseMatrix &matrix, const bool symmetric)
    {
      std::string what = name;
      std::replace(what.begin(), what.end(), '_', ' ');
      write_file(folder + "/" + name + ".mtx", matrix_market_text(matrix, symmetric, comment(body, what)));
    };
    write("mass", body.mass, true);
    write("stiffness", body.stiffness, true);
    const bool couples = body.structural_damping.m() > 0;
    write(couples ? "structural_damping" : "damping", couples ? body.structural_damping : body.damping, true);
    write("recovery", body.recovery, false);
    write("translations", body.translations, false);

    Table dofs({"node", "x_m", "y_m", "z_m", "direction"},
               {"Rows of recovery.mtx: contact points of " + body.name});
    Table groups({"group", "node"}, {"Groups of nodes of " + body.name});
    for (unsigned int component = 0; component < 3; ++component)
      for (unsigned int i = 0; i < body.points.size(); ++i)
        dofs.add_row({double(i + 1), body.points[i][0], body.points[i][1], body.points[i][2],
                      std::string(component == 0   ? "z"
                                  : component == 1 ? "x"
                                                   : "y")});
    for (unsigned int i = 0; i < body.points.size(); ++i)
      groups.add_row({std::string("contact"), double(i + 1)});
    dofs.write(folder + "/dofs.csv");
    groups.write(folder + "/groups.csv");
    write_file(
        folder + "/body.prm",
        "# The section of a parameter file that reads these matrices; names count from the folder of that "
        "file.\nsubsection " +
            body.name +
            "\n  set Type = matrices\n  subsection Matrices\n    set Stiffness = stiffness.mtx\n" +
            "    set Mass = mass.mtx\n    set " +
            (couples ? "Structural damping = structural_damping.mtx" : "Damping = damping.mtx") +
            "\n    set Recovery = recovery.mtx\n    set Translations = translations.mtx\n"
            "    set Dofs = dofs.csv\n    set Groups = groups.csv\n    set Contact group = contact\n"
            "  end\n  subsection Modes\n    set Count = " +
            std::to_string(body.n_modes - body.n_rigid_modes) + "\n  end\nend\n");
  }

  namespace
  {
    void write_points(Hdf5Writer &file, const BodyMatrices &body)
    {
      DenseMatrix points(body.points.size(), 3);
      for (unsigned int i = 0; i < body.points.size(); ++i)
        for (unsigned int d = 0; d < 3; ++d)
          points(i, d) = body.points[i][d];
      file.write("contact_points_m", points);
      std::string labels;
      for (const std::string &label : body.labels)
        labels += (labels.empty() ? "" : "\n") + label;
      file.write("labels", labels);
      file.write("omega_rad_s", body.omega);
      file.write("damping_ratio", body.damping_ratio);
    }
  } // namespace

  void write_matrices_hdf5(const BodyMatrices &body, const std::string &name)
  {
    Hdf5Writer file(name);
    write_points(file, body);
    file.write("mass", body.mass);
    file.write("stiffness", body.stiffness);
    if (body.structural_damping.m() > 0)
      file.write("structural_damping", body.structural_damping);
    else
      file.write("damping", body.damping);
    file.write("recovery", body.recovery);
    file.write("translations", body.translations);
    file.finish();
  }

  void write_state_space(const BodyMatrices &body, const std::string &name)
  {
    const StateSpace space = state_space(body);
    Hdf5Writer file(name);
    file.write("A", space.A);
    file.write("B", space.B);
    file.write("C", space.C);
    file.write("D", space.D);
    write_points(file, body);
    file.finish();
  }
} // namespace vibrocontact
