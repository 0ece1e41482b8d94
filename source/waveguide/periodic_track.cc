#include <vibrocontact/numerics/complex_eigenvectors.h>
#include <vibrocontact/waveguide/periodic_track.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr double place_slack = 1e-9;
    /// of a load to spans that move in all shapes of the section as well [m]: what it does to the section has decayed there
    constexpr double near_load = 0.15;

    DenseVector kept_of(const DenseVector &vector, const std::vector<unsigned int> &kept)
    {
      if (kept.empty())
        return vector;
      DenseVector result(kept.size());
      for (unsigned int i = 0; i < kept.size(); ++i)
        result(i) = vector(kept[i]);
      return result;
    }

    DenseMatrix kept_of(const DenseMatrix &matrix, const std::vector<unsigned int> &kept)
    {
      DenseMatrix result(kept.size(), kept.size());
      for (unsigned int i = 0; i < kept.size(); ++i)
        for (unsigned int j = 0; j < kept.size(); ++j)
          result(i, j) = matrix(kept[i], kept[j]);
      return result;
    }

    TrackSection kept_of(const TrackSection &section, const std::vector<unsigned int> &kept)
    {
      if (kept.empty())
        return section;
      TrackSection result = section;
      for (auto *set : {&result.matrices.stiffness, &result.matrices.loss_stiffness, &result.foot_springs})
        for (DenseMatrix &matrix : *set)
          matrix = kept_of(matrix, kept);
      result.matrices.mass = kept_of(section.matrices.mass, kept);
      result.matrices.axial.clear();
      for (const unsigned int k : kept)
        result.matrices.axial.push_back(section.matrices.axial[k]);
      for (DenseVector &load : result.foot_loads)
        load = kept_of(load, kept);
      result.foot_lever = kept_of(section.foot_lever, kept);
      return result;
    }

    /// The ends move in these shapes alone.
    Slice ends_in(const Slice &slice, const std::vector<unsigned int> &kept)
    {
      if (kept.empty())
        return slice;
      const unsigned int m = slice.n_shapes(), n = kept.size();
      const auto row = [&](const unsigned int i) { return kept[i % n] + i / n * m; };
      Slice result;
      result.stiffness.reinit(2 * n, 2 * n);
      result.forces.reinit(2 * n, slice.n_loads());
      result.compliance = slice.compliance;
      for (unsigned int i = 0; i < 2 * n; ++i)
      {
        for (unsigned int j = 0; j < 2 * n; ++j)
          result.stiffness(i, j) = slice.stiffness(row(i), row(j));
        for (unsigned int j = 0; j < slice.n_loads(); ++j)
          result.forces(i, j) = slice.forces(row(i), j);
      }
      return result;
    }

    /// Motion of the far end of a slice under that of its near end, what follows beyond the far end being known:
    /// (S_ff + Z) q_f = -S_fn q_n.
    /// @param near, far first dofs of the ends, 0 and m
    ComplexMatrix across(const Slice &slice, const ComplexMatrix &Z, const unsigned int near,
                         const unsigned int far)
    {
      const unsigned int m = slice.n_shapes();
      ComplexMatrix middle(m, m), result(m, m);
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
        {
          middle(r, c) = slice.stiffness(far + r, far + c) + (Z.m() > 0 ? Z(r, c) : Complex(0));
          result(r, c) = -slice.stiffness(far + r, near + c);
        }
      middle.compute_lu_factorization();
      middle.solve(result);
      return result;
    }

    /// Dynamic stiffness of a slice at its near end.
    ComplexMatrix before(const Slice &slice, const ComplexMatrix &Z, const unsigned int near,
                         const unsigned int far)
    {
      const unsigned int m = slice.n_shapes();
      const ComplexMatrix motion = across(slice, Z, near, far);
      ComplexMatrix result(m, m), coupling(m, m);
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
        {
          result(r, c) = slice.stiffness(near + r, near + c);
          coupling(r, c) = slice.stiffness(near + r, far + c);
        }
      coupling.mmult(result, motion, true);
      return result;
    }
  } // namespace

  TrackSpan PeriodicTrack::span_of(const int number) const
  {
    const int n = own.size();
    const auto place = [&](const int j)
    {
      if (n == 0)
        return first_support + j * spacing;
      return j < 0    ? own.front().place + j * spacing
             : j >= n ? own.back().place + (j - n + 1) * spacing
                      : own[j].place;
    };
    // equal spans are equally long in spite of rounding
    TrackSpan span;
    span.support = place(number);
    span.begin =
        number > 0 && number < n ? (place(number - 1) + span.support) / 2 : span.support - spacing / 2;
    span.end =
        number >= 0 && number + 1 < n ? (place(number + 1) + span.support) / 2 : span.support + spacing / 2;
    span.pad_factor = is_own(number) ? own[number].pad_factor : 1;
    return span;
  }

  int PeriodicTrack::number_at(const double place) const
  {
    if (own.empty())
      return std::ceil((place - first_support) / spacing - 0.5 - place_slack);
    if (place <= span_of(0).begin + place_slack)
      return -1 - int(std::floor((span_of(0).begin - place) / spacing + place_slack));
    const int n = own.size();
    for (int j = 0; j < n; ++j)
      if (place <= span_of(j).end + place_slack)
        return j;
    return n - 1 + int(std::ceil((place - span_of(n - 1).end) / spacing - place_slack));
  }

  std::pair<double, double> PeriodicTrack::reach() const
  {
    if (own.empty() || beyond == TrackEnds::track)
      return {-1e300, 1e300};
    return {span_of(0).begin, span_of(own.size() - 1).end};
  }

  PeriodicTrack PeriodicTrack::regular() const
  {
    PeriodicTrack result = *this;
    result.own.clear();
    result.beyond = TrackEnds::track;
    return result;
  }

  TrackSection PeriodicTrack::whole_section(const bool far) const
  {
    const TrackSection rail = far ? kept_of(section, far_shapes) : section;
    return slab ? with_slab(rail, *slab) : rail;
  }

  std::vector<unsigned int> PeriodicTrack::far_of_whole() const
  {
    std::vector<unsigned int> result = far_shapes;
    const unsigned int m = section.matrices.n_shapes();
    if (slab && !result.empty())
      result.insert(result.end(), {m, m + 1});
    return result;
  }

  AxialLoad PeriodicTrack::on_whole(const AxialLoad &load) const
  {
    AxialLoad result = load;
    if (slab)
    {
      result.constant = with_slab_at_rest(load.constant);
      result.linear = with_slab_at_rest(load.linear);
    }
    return result;
  }

  ComplexMatrix PeriodicTrack::seat(const Complex omega, const RailPair pair) const
  {
    return support.sleeper.any() ? seat_receptance(support.sleeper, omega, pair) : ComplexMatrix();
  }

  PeriodicTrack::AtFrequency PeriodicTrack::at(const Complex omega) const
  {
    AtFrequency result;
    result.omega = omega;
    const TrackSection far = whole_section(true);
    const SpanElements elements = {element_length, degree};
    const bool two_rails = support.sleeper.any() && support.sleeper.beam;
    const auto pieces = [&](const TrackSpan &span)
    { return span_pieces(far, support, support.sleeper.n_motions(), span, elements, omega, {}); };
    const SpanPieces of_equal =
        pieces({first_support, first_support - spacing / 2, first_support + spacing / 2, 1});
    const unsigned int n = own.size();
    std::vector<SpanPieces> of_own;
    // spans of a finite track without scatter are those before them
    std::vector<unsigned int> made;
    for (unsigned int k = 0; k < n; ++k)
    {
      const TrackSpan span = span_of(k), last = k > 0 ? span_of(k - 1) : TrackSpan();
      const auto same = [&](const double a, const double b) { return std::abs(a - b) < 1e-12 * spacing; };
      if (!(k > 0 && span.pad_factor == last.pad_factor &&
            same(span.support - span.begin, last.support - last.begin) &&
            same(span.end - span.support, last.end - last.support)))
        of_own.push_back(pieces(span));
      made.push_back(of_own.size() - 1);
    }
    for (const RailPair pair : two_rails ? pairs : std::vector<RailPair>{RailPair::antisymmetric})
    {
      RailMotion motion;
      motion.seat = seat(omega, pair);
      motion.span = on_seat(of_equal, motion.seat);
      InfiniteEnds ends;
      if (own.empty() || beyond == TrackEnds::track)
        ends = infinite_ends(motion.span);
      else if (beyond == TrackEnds::rail && omega != 0.)
        // at rest a rail alone carries nothing
        ends = infinite_ends(
            uniform_slice(SectionAtFrequency(far.matrices, omega), spacing, element_length, degree));
      for (unsigned int k = 0; k < n; ++k)
        motion.own_spans.push_back(k > 0 && made[k] == made[k - 1] ? motion.own_spans.back()
                                                                   : on_seat(of_own[made[k]], motion.seat));
      const unsigned int m = far.matrices.n_shapes();
      motion.left = {ends.left};
      for (unsigned int k = 0; k < n; ++k)
        motion.left.push_back(before(motion.own_spans[k], motion.left.back(), m, 0));
      motion.right.resize(n + 1);
      motion.right[n] = ends.right;
      for (unsigned int k = n; k-- > 0;)
        motion.right[k] = before(motion.own_spans[k], motion.right[k + 1], 0, m);
      result.motions.push_back(std::move(motion));
    }
    return result;
  }

  const ComplexMatrix &PeriodicTrack::right_of(const RailMotion &motion, const int number) const
  {
    return motion.right[std::clamp<int>(number + 1, 0, own.size())];
  }

  const ComplexMatrix &PeriodicTrack::left_of(const RailMotion &motion, const int number) const
  {
    return motion.left[std::clamp<int>(number, 0, own.size())];
  }

  std::pair<int, int> PeriodicTrack::loaded_spans(const std::vector<AxialLoad> &loads) const
  {
    double from = 1e300, to = -1e300;
    for (const AxialLoad &load : loads)
    {
      from = std::min(from, load.centre - load.length / 2);
      to = std::max(to, load.centre + load.length / 2);
    }
    // and what is near them, as far as the track goes
    const auto [begin, end] = reach();
    from = std::min(from, std::max(from - near_of_loads(), begin + 2 * place_slack));
    to = std::max(to, std::min(to + near_of_loads(), end - 2 * place_slack));
    int first = number_at(from), last = std::max(first, number_at(to));
    if (!own.empty())
    {
      // up to a border beyond which all is known
      first = std::min<int>(first, own.size());
      last = std::max(last, -1);
    }
    return {first, last};
  }

  double PeriodicTrack::near_of_loads() const
  {
    return far_shapes.empty() ? 0. : near_load;
  }

  PeriodicTrack::LoadedPart PeriodicTrack::loaded_part(const Complex omega,
                                                       const std::vector<AxialLoad> &rail_loads,
                                                       const std::pair<int, int> &range) const
  {
    const TrackSection whole = whole_section(false);
    std::vector<AxialLoad> loads;
    for (const AxialLoad &load : rail_loads)
      loads.push_back(on_whole(load));
    LoadedPart part;
    std::tie(part.first, part.last) = range;
    part.n_loads = loads.size();
    for (int j = part.first; j <= part.last; ++j)
    {
      const TrackSpan span = span_of(j);
      const bool is_near = std::any_of(loads.begin(), loads.end(),
                                       [&](const AxialLoad &load)
                                       {
                                         const double half = load.length / 2 + near_of_loads();
                                         return load.centre + half > span.begin + place_slack &&
                                                load.centre - half < span.end + place_slack;
                                       });
      part.pieces.emplace_back();
      if (is_near)
        part.pieces.back() = span_pieces(whole, support, support.sleeper.n_motions(), span,
                                         {element_length, degree}, omega, loads);
    }
    return part;
  }

  Slice PeriodicTrack::in_motion(const LoadedPart &part, const RailMotion &motion) const
  {
    // spans with loads in all shapes, up to the next one without
    std::optional<Slice> track, near;
    const auto close = [&]
    {
      if (near)
        follow(track, ends_in(*near, far_of_whole()));
      near.reset();
    };
    for (int j = part.first; j <= part.last; ++j)
      if (const std::optional<SpanPieces> &loaded = part.pieces[j - part.first])
        follow(near, on_seat(*loaded, motion.seat));
      else
      {
        close();
        follow(track, with_loads(unloaded(motion, j), part.n_loads));
      }
    close();
    return *track;
  }

  ComplexMatrix PeriodicTrack::receptance(const AtFrequency &at, const std::vector<AxialLoad> &loads) const
  {
    const LoadedPart part = loaded_part(at.omega, loads, loaded_spans(loads));
    ComplexMatrix sum(loads.size(), loads.size());
    for (const RailMotion &motion : at.motions)
      sum.add(1. / at.motions.size(),
              vibrocontact::receptance(in_motion(part, motion), left_of(motion, part.first),
                                       right_of(motion, part.last)));
    return sum;
  }

  std::vector<std::vector<Complex>> PeriodicTrack::along(const AtFrequency &at,
                                                         const std::vector<AxialLoad> &loads,
                                                         const std::vector<DenseVector> &rows,
                                                         const unsigned int n_spans) const
  {
    const unsigned int m_all = section.matrices.n_shapes(), n = loads.size();
    const double centre = loads.front().centre;
    const auto observed = [&](const double x, const unsigned int j)
    {
      AxialLoad place;
      place.centre = x;
      place.constant = rows[j];
      place.linear.reinit(m_all);
      return place;
    };
    const auto [first, last] = loaded_spans(loads);
    const auto place = [&](const unsigned int j) { return centre + j * spacing / 4; };
    unsigned int n_places = 4 * n_spans + 1, n_near = 1;
    while (n_places > 1 && place(n_places - 1) > reach().second - place_slack)
      --n_places;
    while (n_near < n_places && place(n_near) < span_of(last).end + place_slack)
      ++n_near;
    std::vector<AxialLoad> near = loads;
    for (unsigned int j = 1; j < n_near; ++j)
      for (unsigned int l = 0; l < n; ++l)
        near.push_back(observed(place(j), l));
    std::vector<std::vector<Complex>> result(n, std::vector<Complex>(n_places));
    const LoadedPart pieces = loaded_part(at.omega, near, {first, last});
    for (const RailMotion &motion : at.motions)
    {
      const double share = 1. / at.motions.size();
      const Slice part = in_motion(pieces, motion);
      const InfiniteEnds ends = {right_of(motion, last), left_of(motion, first)};
      const ComplexMatrix H = vibrocontact::receptance(part, ends.left, ends.right);
      ComplexMatrix q = end_motions(part, ends), begin(part.n_shapes(), n), finish(begin);
      const unsigned int m = part.n_shapes();
      for (unsigned int l = 0; l < n; ++l)
      {
        for (unsigned int j = 0; j < n_near; ++j)
          result[l][j] += share * H(j * n + l, l);
        for (unsigned int r = 0; r < m; ++r)
          begin(r, l) = q(m + r, l);
      }
      // from span to span, equal ones alike
      std::vector<double> offsets;
      Slice next;
      ComplexMatrix over;
      unsigned int j = n_near;
      for (int number = last + 1; j < n_places; ++number)
      {
        const TrackSpan span = span_of(number);
        std::vector<AxialLoad> further;
        std::vector<double> further_offsets;
        unsigned int end = j;
        for (; end < n_places && place(end) < span.end + place_slack; ++end)
        {
          further_offsets.push_back(place(end) - span.begin);
          for (unsigned int l = 0; l < n; ++l)
            further.push_back(observed(place(end), l));
        }
        const bool as_before =
            !is_own(number) && number != last + 1 && !is_own(number - 1) &&
            std::equal(offsets.begin(), offsets.end(), further_offsets.begin(), further_offsets.end(),
                       [](const double a, const double b) { return std::abs(a - b) < 1e-9; });
        if (!as_before)
        {
          std::vector<AxialLoad> reduced = further;
          for (AxialLoad &load : reduced)
          {
            load.constant = kept_of(load.constant, far_shapes);
            load.linear = kept_of(load.linear, far_shapes);
            load = on_whole(load);
          }
          next = span_slice(whole_section(true), support, motion.seat, span, {element_length, degree},
                            at.omega, reduced);
          over = across(next, right_of(motion, number), 0, m);
        }
        offsets = further_offsets;
        over.mmult(finish, begin);
        for (unsigned int k = 0; j < end; ++j, ++k)
          for (unsigned int l = 0; l < n; ++l)
            for (unsigned int r = 0; r < m; ++r)
              result[l][j] += share * (next.forces(r, k * n + l) * begin(r, l) +
                                       next.forces(m + r, k * n + l) * finish(r, l));
        begin = finish;
      }
    }
    return result;
  }

  std::vector<std::vector<Complex>> PeriodicTrack::span_factors(const AtFrequency &at) const
  {
    std::vector<std::vector<Complex>> result;
    for (const RailMotion &motion : at.motions)
    {
      std::vector<Complex> factors =
          complex_eigenvectors(across(motion.span, motion.right.back(), 0, motion.span.n_shapes()),
                               "waves from span to span")
              .values;
      std::sort(factors.begin(), factors.end(),
                [](const Complex &a, const Complex &b) { return std::abs(a) > std::abs(b); });
      result.push_back(factors);
    }
    return result;
  }
} // namespace vibrocontact
