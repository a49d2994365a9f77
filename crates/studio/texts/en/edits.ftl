# edits

# In the viewport
edit-orbit = Orbit the camera
edit-pan = Pan the camera
edit-dolly = Dolly the camera
edit-fly = Fly the camera
edit-frame = Frame
edit-projection = Change the projection
edit-camera-from-view = Put the camera at the view
edit-move = Move
edit-rotate = Rotate
edit-scale = Scale
