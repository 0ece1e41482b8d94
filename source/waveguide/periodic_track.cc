#include <vibrocontact/waveguide/periodic_track.h>
#include <vibrocontact/waveguide/plane_section.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vibrocontact
{
  using namespace dealii;
  using Complex = std::complex<double>;

  TrackSection track_section(const SectionElements &elements, const SectionShapes &shapes)
  {
    TrackSection result;
    result.matrices = reduced_section(elements, shapes);
    const auto [from, to] = elements.extent(section_boundary::foot);
    result.foot_width = to - from;
    for (unsigned int d = 0; d < 3; ++d)
    {
      SparseMatrix<double> springs(elements.pattern);
      elements.boundary_springs(section_boundary::foot, d, springs);
      result.foot_springs[d] = reduced_matrix(springs, shapes);
      result.foot_loads[d] = shapes.reduced(elements.boundary_load(section_boundary::foot, from, to, d));
    }
    return result;
  }

  namespace
  {
    /// The pad's slice has forces of 1 N between sleeper and foot as its last three loads, the sleeper held. It moves by r:
    /// the pad then pushes with c = k r, and (k + D) r = k d, d the foot's mean motion, D sleeper and ballast.
    Slice on_sleeper(const Slice &pad, const TrackSupport &support, const Complex omega)
    {
      const unsigned int n = pad.n_loads() - 3, n_ends = pad.stiffness.m();
      ComplexMatrix Y(3, 3), sleeper(3, n_ends + n);
      for (unsigned int d = 0; d < 3; ++d)
      {
        const Complex k = support.pad_stiffness[d] * Complex(1, support.pad_loss),
                      D = support.ballast_stiffness[d] * Complex(1, support.ballast_loss) -
                          omega * omega * support.sleeper_mass;
        for (unsigned int e = 0; e < 3; ++e)
          Y(d, e) = (d == e ? (k + D) / (k * k) : 0.) - pad.compliance(n + d, n + e);
        for (unsigned int i = 0; i < n_ends; ++i)
          sleeper(d, i) = pad.forces(i, n + d);
        for (unsigned int j = 0; j < n; ++j)
          sleeper(d, n_ends + j) = pad.compliance(n + d, j);
      }
      const ComplexMatrix motions = sleeper;
      Y.compute_lu_factorization();
      Y.solve(sleeper);
      Slice result;
      result.stiffness = pad.stiffness;
      result.forces.reinit(n_ends, n);
      result.compliance.reinit(n, n);
      const auto product = [&](const unsigned int a, const unsigned int b)
      {
        Complex sum = 0;
        for (unsigned int d = 0; d < 3; ++d)
          sum += motions(d, a) * sleeper(d, b);
        return sum;
      };
      for (unsigned int i = 0; i < n_ends; ++i)
      {
        for (unsigned int j = 0; j < n_ends; ++j)
          result.stiffness(i, j) -= product(i, j);
        for (unsigned int j = 0; j < n; ++j)
          result.forces(i, j) = pad.forces(i, j) + product(i, n_ends + j);
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          result.compliance(i, j) = pad.compliance(i, j) + product(n_ends + i, n_ends + j);
      return result;
    }

    void follow(std::optional<Slice> &whole, const Slice &next)
    {
      whole = whole ? join(*whole, next) : next;
    }
  } // namespace

  Slice PeriodicTrack::span(const Complex omega, const double x, const std::vector<AxialLoad> &loads,
                            const double loss) const
  {
    const unsigned int m = section.matrices.n_shapes();
    const double begin = x - spacing / 2, end = x + spacing / 2, pad_begin = x - support.pad_length / 2,
                 pad_end = x + support.pad_length / 2, slack = 1e-9 * spacing;
    ComplexMatrix springs(m, m);
    for (unsigned int d = 0; d < 3; ++d)
    {
      const Complex per_area =
          support.pad_stiffness[d] * Complex(1, support.pad_loss) / (section.foot_width * support.pad_length);
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
          springs(r, c) += per_area * section.foot_springs[d](r, c);
    }
    const auto at_frequency = [&](const ComplexMatrix &bed)
    {
      return loss < 0 ? SectionAtFrequency(section.matrices, omega, bed)
                      : SectionAtFrequency(section.matrices, omega, loss, bed);
    };
    const SectionAtFrequency between = at_frequency(ComplexMatrix()), on_pad = at_frequency(springs);

    std::vector<double> divisions = {begin, pad_begin, pad_end, end};
    for (const AxialLoad &load : loads)
      for (const double place : {load.centre - load.length / 2, load.centre + load.length / 2})
        if (place > begin + slack && place < end + slack)
          divisions.push_back(place);
    std::sort(divisions.begin(), divisions.end());
    divisions.erase(std::unique(divisions.begin(), divisions.end(),
                                [&](const double a, const double b) { return std::abs(a - b) < slack; }),
                    divisions.end());

    /// pieces between two places; `with` may hold the sleeper's forces beside the loads
    const auto pieces = [&](const double from, const double to, const SectionAtFrequency &at,
                            const std::vector<AxialLoad> &with)
    {
      std::optional<Slice> whole;
      for (unsigned int k = 0; k + 1 < divisions.size(); ++k)
      {
        const double a = divisions[k], b = divisions[k + 1];
        if (a < from - slack || b > to + slack)
          continue;
        const bool loaded =
            std::any_of(with.begin(), with.end(),
                        [&](const AxialLoad &load)
                        { return load.length > 0 && std::abs((a + b) / 2 - load.centre) < load.length / 2; });
        std::optional<Slice> piece;
        if (loaded)
        {
          const unsigned int n = std::ceil((b - a) / element_length - 1e-9);
          for (unsigned int e = 0; e < n; ++e)
            follow(piece, element_slice(at, a + e * (b - a) / n, (b - a) / n, degree, with));
        }
        else
          piece = uniform_slice(at, b - a, element_length, degree, with.size());
        for (unsigned int j = 0; j < with.size(); ++j)
          if (with[j].length == 0 && std::abs(with[j].centre - b) < slack)
            add_section_load(*piece, j, with[j].constant);
        follow(whole, *piece);
      }
      return *whole;
    };

    std::vector<AxialLoad> with_sleeper = loads;
    if (support.sleeper_mass > 0)
      for (unsigned int d = 0; d < 3; ++d)
      {
        AxialLoad load;
        load.centre = x;
        load.length = support.pad_length;
        load.constant = section.foot_loads[d];
        load.constant /= section.foot_width * support.pad_length;
        load.linear.reinit(m);
        with_sleeper.push_back(load);
      }
    Slice pad = pieces(pad_begin, pad_end, on_pad, with_sleeper);
    if (support.sleeper_mass > 0)
      pad = on_sleeper(pad, support, omega);
    if (support.pad_length > spacing - 2 * slack)
      return pad;
    return join(join(pieces(begin, pad_begin, between, loads), pad), pieces(pad_end, end, between, loads));
  }

  PeriodicTrack::AtFrequency PeriodicTrack::at(const Complex omega) const
  {
    AtFrequency result;
    result.omega = omega;
    result.span = span(omega, first_support, {});
    result.ends = infinite_ends(result.span);
    return result;
  }

  std::pair<int, int> PeriodicTrack::loaded_spans(const std::vector<AxialLoad> &loads) const
  {
    double from = 1e300, to = -1e300;
    for (const AxialLoad &load : loads)
    {
      from = std::min(from, load.centre - load.length / 2);
      to = std::max(to, load.centre + load.length / 2);
    }
    // a load on the border of two spans belongs to the left one
    const double slack = 1e-9;
    const int first = std::ceil((from - first_support) / spacing - 0.5 - slack);
    return {first, std::max<int>(first, std::ceil((to - first_support) / spacing - 0.5 - slack))};
  }

  Slice PeriodicTrack::loaded_part(const AtFrequency &at, const std::vector<AxialLoad> &loads) const
  {
    const auto [first, last] = loaded_spans(loads);
    const double slack = 1e-9;
    std::optional<Slice> track;
    for (int j = first; j <= last; ++j)
    {
      const double x = first_support + j * spacing;
      const bool loaded = std::any_of(loads.begin(), loads.end(),
                                      [&](const AxialLoad &load)
                                      {
                                        return load.centre + load.length / 2 > x - spacing / 2 + slack &&
                                               load.centre - load.length / 2 < x + spacing / 2 + slack;
                                      });
      Slice next = loaded ? span(at.omega, x, loads) : at.span;
      if (!loaded)
      {
        next.forces.reinit(2 * next.n_shapes(), loads.size());
        next.compliance.reinit(loads.size(), loads.size());
      }
      follow(track, next);
    }
    return *track;
  }

  ComplexMatrix PeriodicTrack::receptance(const AtFrequency &at, const std::vector<AxialLoad> &loads) const
  {
    return vibrocontact::receptance(loaded_part(at, loads), at.ends.left, at.ends.right);
  }

  std::vector<Complex> PeriodicTrack::along(const AtFrequency &at, const AxialLoad &load,
                                            const DenseVector &row, const unsigned int n_spans) const
  {
    const unsigned int m = section.matrices.n_shapes();
    const auto observed = [&](const double x)
    {
      AxialLoad place;
      place.centre = x;
      place.constant = row;
      place.linear.reinit(m);
      return place;
    };
    const double last = first_support + loaded_spans({load}).second * spacing, end = last + spacing / 2;
    std::vector<AxialLoad> loads = {load};
    while (load.centre + loads.size() * spacing / 4 < end + 1e-9)
      loads.push_back(observed(load.centre + loads.size() * spacing / 4));
    const Slice part = loaded_part(at, loads);
    const ComplexMatrix H = vibrocontact::receptance(part, at.ends.left, at.ends.right);
    std::vector<Complex> result;
    for (unsigned int j = 0; j < loads.size(); ++j)
      result.push_back(H(j, 0));

    // motion of its right end, then from span to span: (S22 + Z) q' = -S21 q
    const ComplexMatrix q = end_motions(part, at.ends);
    std::vector<AxialLoad> further;
    for (unsigned int j = 1; j <= 4; ++j)
      further.push_back(observed(last + spacing / 2 + j * spacing / 4));
    const Slice next = span(at.omega, last + spacing, further);
    ComplexMatrix middle(m, m), across(m, m);
    for (unsigned int c = 0; c < m; ++c)
      for (unsigned int r = 0; r < m; ++r)
      {
        middle(r, c) = next.stiffness(m + r, m + c) + at.ends.right(r, c);
        across(r, c) = -next.stiffness(m + r, c);
      }
    middle.compute_lu_factorization();
    middle.solve(across);
    std::vector<Complex> begin(m), finish(m);
    for (unsigned int r = 0; r < m; ++r)
      begin[r] = q(m + r, 0);
    for (unsigned int k = 0; k < n_spans; ++k)
    {
      for (unsigned int r = 0; r < m; ++r)
      {
        finish[r] = 0;
        for (unsigned int c = 0; c < m; ++c)
          finish[r] += across(r, c) * begin[c];
      }
      for (unsigned int j = 0; j < further.size(); ++j)
      {
        Complex motion = 0;
        for (unsigned int r = 0; r < m; ++r)
          motion += next.forces(r, j) * begin[r] + next.forces(m + r, j) * finish[r];
        result.push_back(motion);
      }
      begin = finish;
    }
    return result;
  }

  double track_decay_rate(const std::vector<Complex> &responses, const double step)
  {
    double sum = 0;
    for (unsigned int j = 0; j < responses.size(); ++j)
      sum += std::norm(responses[j] / responses[0]) * (j == 0 ? step / 2 : step);
    return 4.343 / sum;
  }
} // namespace vibrocontact
