-- A delivery van of up to 3.5 t. OSRM's car, but higher, wider, longer and heavier; ways that state
-- access for goods vehicles hold for it. Where OSRM lies is in LUA_PATH.
local car = require('car')

local function setup()
  local profile = car.setup()
  profile.vehicle_height = 2.8
  profile.vehicle_width = 2.1
  profile.vehicle_length = 6.9
  profile.vehicle_weight = 3500
  profile.vehicle_max_speed = 120
  profile.access_tags_hierarchy = Sequence { 'goods', 'motor_vehicle', 'vehicle', 'access' }
  profile.restrictions = Sequence { 'goods', 'motor_vehicle', 'vehicle' }
  profile.access_tag_whitelist['goods'] = true
  return profile
end

return {
  setup = setup,
  process_way = car.process_way,
  process_node = car.process_node,
  process_turn = car.process_turn
}
