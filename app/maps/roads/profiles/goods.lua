-- A vehicle for goods: OSRM's car, but of its own size and speed, and ways that state access or toll
-- for its kind hold for it; ways too low, narrow or weak for it are closed.
local car = require('car')
local avoidable = require('avoidable')

return function(size, access)
  local function setup()
    local profile = car.setup()
    for name, value in pairs(size) do
      profile['vehicle_' .. name] = value
    end
    profile.access_tags_hierarchy = Sequence { access, 'motor_vehicle', 'vehicle', 'access' }
    profile.restrictions = Sequence { access, 'motor_vehicle', 'vehicle' }
    profile.access_tag_whitelist[access] = true
    return profile
  end

  return avoidable({
    setup = setup,
    process_way = car.process_way,
    process_node = car.process_node,
    process_turn = car.process_turn
  }, 'toll:' .. access)
end
