-- A truck of 18 t with two axles, as large as it may be in most of Europe.
return require('goods')({ height = 4.0, width = 2.55, length = 12.0, weight = 18000, max_speed = 80 }, 'hgv')
