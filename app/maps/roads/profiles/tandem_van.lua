-- A delivery van of up to 3.5 t: higher, wider, longer and heavier than a car.
return require('goods')({ height = 2.8, width = 2.1, length = 6.9, weight = 3500, max_speed = 120 }, 'goods')
