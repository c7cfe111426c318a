-- A truck of 18 t with two axles, as large as it may be in most of Europe. OSRM's car, but for ways
-- that are too low, narrow or weak for it, ways closed to heavy goods vehicles, and its speed. Where
-- OSRM lies is in LUA_PATH.
local car = require('car')

local function setup()
  local profile = car.setup()
  profile.vehicle_height = 4.0
  profile.vehicle_width = 2.55
  profile.vehicle_length = 12.0
  profile.vehicle_weight = 18000
  profile.vehicle_max_speed = 80
  profile.access_tags_hierarchy = Sequence { 'hgv', 'motor_vehicle', 'vehicle', 'access' }
  profile.restrictions = Sequence { 'hgv', 'motor_vehicle', 'vehicle' }
  profile.access_tag_whitelist['hgv'] = true
  return profile
end

return {
  setup = setup,
  process_way = car.process_way,
  process_node = car.process_node,
  process_turn = car.process_turn
}
