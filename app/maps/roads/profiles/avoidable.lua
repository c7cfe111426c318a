-- A vehicle that can be told to keep off tolls, motorways and ferries, and several of them at once:
-- OSRM has room for six ways to. Where it lies is in LUA_PATH.
return function(vehicle, toll_tag)
  local function setup()
    local profile = vehicle.setup()
    profile.classes = Sequence { 'toll', 'motorway', 'ferry', 'restricted', 'tunnel' }
    profile.excludable = Sequence {
      Set { 'toll' }, Set { 'motorway' }, Set { 'ferry' },
      Set { 'toll', 'motorway' }, Set { 'toll', 'ferry' }, Set { 'toll', 'motorway', 'ferry' }
    }
    return profile
  end

  local function process_way(profile, way, result, relations)
    vehicle.process_way(profile, way, result, relations)
    -- OSRM's bicycle doesn't ask on which side it rides.
    WayHandlers.driving_side(profile, way, result)
    local toll = toll_tag and way:get_value_by_key(toll_tag)
    if toll then
      result.forward_classes['toll'] = toll ~= 'no'
      result.backward_classes['toll'] = toll ~= 'no'
    end
  end

  return {
    setup = setup,
    process_way = process_way,
    process_node = vehicle.process_node,
    process_turn = vehicle.process_turn
  }
end
