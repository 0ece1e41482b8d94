#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>

#include <functional>
#include <memory>

namespace vibrocontact
{
  /// The scene at a value of the followed entry, and the map of a period of its march, which refers to it.
  struct CycleAt
  {
    CycleAt() = default;
    CycleAt(const CycleAt &) = delete;
    CycleAt &operator=(const CycleAt &) = delete;

    CycleScene scene;
    std::unique_ptr<CycleMap> map;
    /// CycleMap::pack() of the state at rest
    DenseVector equilibrium;
  };
  /// @throws ConvergenceError if there is no equilibrium at the value
  using CycleFamily = std::function<std::shared_ptr<CycleAt>(double value)>;
} // namespace vibrocontact
